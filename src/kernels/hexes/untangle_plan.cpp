#include "kernels/hexes/untangle_plan.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "graph/parallel/ordered_reduce.h"
#include "graph/parallel/parallel_map.h"

namespace strataflow {
namespace {

using Numbers = std::vector<double>;

double inner(const Numbers& a, const Numbers& b) {
  return ordered_reduce(
      a.size(), 0.0, [&](std::size_t i) { return a[i] * b[i]; }, std::plus<double>());
}

/// Σ |t| (f + g) of the tetrahedra, f the shape and g the size of the deformation's gradient, over the unknowns (u, then
/// v).
class FoldoverEnergy {
 public:
  FoldoverEnergy(const LabelledTets& tets, const UprightSystem& system, const std::vector<TetGradients>& gradients)
      : tets_(tets), system_(system), gradients_(gradients), first_(tets.points.size() + 1, 0),
        first_follower_(system.unknown_count + 1, 0) {
    for (const Tet& tet : tets.tets)
      for (const std::uint32_t p : tet) ++first_[p + 1];
    for (std::size_t p = 0; p < tets.points.size(); ++p) first_[p + 1] += first_[p];
    corners_.resize(4 * tets.tets.size());
    std::vector<std::uint32_t> next = first_;
    for (std::uint32_t t = 0; t < tets.tets.size(); ++t)
      for (std::uint32_t k = 0; k < 4; ++k) corners_[next[tets.tets[t][k]]++] = 4 * t + k;
    for (const UprightSystem::Share& share : system.shares) ++first_follower_[share.unknown + 1];
    for (std::uint32_t i = 0; i < system.unknown_count; ++i) first_follower_[i + 1] += first_follower_[i];
    followers_.resize(system.shares.size());
    next = first_follower_;
    for (std::uint32_t p = 0; p < tets.points.size(); ++p)
      for (std::uint32_t s = system.first[p]; s < system.first[p + 1]; ++s)
        followers_[next[system.shares[s].unknown]++] = {p, system.shares[s].weight};
  }

  double smallest_determinant(const Numbers& x) const {
    const std::vector<Place> places = expanded(x);
    return ordered_reduce(
        tets_.tets.size(), std::numeric_limits<double>::infinity(),
        [&](std::size_t t) {
          const auto [du, dv] = jacobian(t, places);
          return du.x * dv.y - du.y * dv.x;
        },
        [](double a, double b) { return std::min(a, b); });
  }

  /// The energy at x with χ smoothed by `epsilon`, and its gradient.
  double operator()(const Numbers& x, double epsilon, Numbers& gradient) const {
    const std::vector<Place> places = expanded(x);
    struct Pull {
      double energy;
      std::array<Place, 4> corner;
    };
    const std::vector<Pull> pulls = parallel_map(
        tets_.tets.size(),
        [&](std::size_t t) {
          const auto [du, dv] = jacobian(t, places);
          const double d = du.x * dv.y - du.y * dv.x, root = std::sqrt(d * d + epsilon * epsilon);
          const double chi = d >= 0 ? 0.5 * (d + root) : 0.5 * epsilon * epsilon / (root - d), slope = chi / root;
          const double trace = dot(du, du) + dot(dv, dv) + 1, power = std::cbrt(chi * chi);
          const double volume = gradients_[t].volume_m3;
          Pull pull{};
          pull.energy = volume * (trace / power + (d * d + 1) / chi);
          const double by_d = -(2.0 / 3) * trace * slope / (power * chi) + 2 * d / chi - (d * d + 1) * slope / (chi * chi);
          const Vec3 by_u = (2 / power) * du + by_d * Vec3{dv.y, -dv.x, 0};
          const Vec3 by_v = (2 / power) * dv + by_d * Vec3{-du.y, du.x, 0};
          for (std::size_t k = 0; k < 4; ++k)
            pull.corner[k] = {volume * dot(by_u, gradients_[t].gradient[k]), volume * dot(by_v, gradients_[t].gradient[k])};
          return pull;
        },
        512);
    const std::vector<Place> at_point = parallel_map(
        tets_.points.size(),
        [&](std::size_t p) {
          Place sum{0, 0};
          for (std::uint32_t i = first_[p]; i < first_[p + 1]; ++i)
            for (std::size_t axis = 0; axis < 2; ++axis) sum[axis] += pulls[corners_[i] / 4].corner[corners_[i] % 4][axis];
          return sum;
        },
        1024);
    const std::size_t count = system_.unknown_count;
    gradient.resize(2 * count);
    parallel_ranges(count, 1024, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        for (std::size_t axis = 0; axis < 2; ++axis) {
          double sum = 0;
          for (std::uint32_t f = first_follower_[i]; f < first_follower_[i + 1]; ++f)
            sum += followers_[f].weight * at_point[followers_[f].point][axis];
          gradient[axis * count + i] = sum;
        }
    });
    return ordered_reduce(
        pulls.size(), 0.0, [&](std::size_t t) { return pulls[t].energy; }, std::plus<double>());
  }

 private:
  using Place = std::array<double, 2>;

  std::vector<Place> expanded(const Numbers& x) const {
    return parallel_map(
        tets_.points.size(),
        [&](std::size_t p) {
          Place place{0, 0};
          for (std::uint32_t s = system_.first[p]; s < system_.first[p + 1]; ++s)
            for (std::size_t axis = 0; axis < 2; ++axis)
              place[axis] += system_.shares[s].weight * x[axis * system_.unknown_count + system_.shares[s].unknown];
          return place;
        },
        1024);
  }

  std::pair<Vec3, Vec3> jacobian(std::size_t t, const std::vector<Place>& places) const {
    Vec3 du, dv;
    for (std::size_t k = 0; k < 4; ++k) {
      const Place& place = places[tets_.tets[t][k]];
      du = du + place[0] * gradients_[t].gradient[k];
      dv = dv + place[1] * gradients_[t].gradient[k];
    }
    return {du, dv};
  }

  struct Follower {
    std::uint32_t point;
    double weight;
  };
  const LabelledTets& tets_;
  const UprightSystem& system_;
  const std::vector<TetGradients>& gradients_;
  std::vector<std::uint32_t> first_, corners_;  // per point: corners 4·tet + k
  std::vector<std::uint32_t> first_follower_;   // per unknown, plus one
  std::vector<Follower> followers_;
};

/// Limited-memory BFGS whose first guess of the inverse Hessian is that of the linear deformation, scaled to what the
/// last step met.
class GuidedDescent {
 public:
  explicit GuidedDescent(const Multigrid& guide) : guide_(guide), count_(guide.matrix().size()) {}

  bool knows_nothing() const { return pairs_.empty(); }
  void forget() {
    pairs_.clear();
    scale_ = 1;
  }

  void remember(Numbers step, Numbers change) {
    const double curvature = inner(step, change);
    if (!(curvature > 0)) return;
    scale_ = curvature / inner(change, guided(change));
    pairs_.push_back({std::move(step), std::move(change), curvature});
    if (pairs_.size() > 8) pairs_.pop_front();
  }

  Numbers direction(const Numbers& gradient) const {
    Numbers q = gradient;
    std::vector<double> alpha(pairs_.size());
    for (std::size_t i = pairs_.size(); i-- > 0;) {
      alpha[i] = inner(pairs_[i].step, q) / pairs_[i].curvature;
      add(q, -alpha[i], pairs_[i].change);
    }
    q = guided(q);
    parallel_ranges(q.size(), reduce_grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t j = begin; j < end; ++j) q[j] *= scale_;
    });
    for (std::size_t i = 0; i < pairs_.size(); ++i)
      add(q, alpha[i] - inner(pairs_[i].change, q) / pairs_[i].curvature, pairs_[i].step);
    parallel_ranges(q.size(), reduce_grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t j = begin; j < end; ++j) q[j] = -q[j];
    });
    return q;
  }

 private:
  static void add(Numbers& to, double share, const Numbers& what) {
    parallel_ranges(to.size(), reduce_grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t j = begin; j < end; ++j) to[j] += share * what[j];
    });
  }

  Numbers guided(const Numbers& q) const {
    const auto half = q.begin() + count_;
    Numbers result = guide_(Numbers(q.begin(), half));
    const Numbers v = guide_(Numbers(half, q.end()));
    result.insert(result.end(), v.begin(), v.end());
    return result;
  }

  struct Pair {
    Numbers step, change;
    double curvature;
  };
  const Multigrid& guide_;
  std::uint32_t count_;
  double scale_ = 1;
  std::deque<Pair> pairs_;
};

}  // namespace

UntangledPlan untangle_plan(const LabelledTets& tets, const UprightSystem& system,
                            const std::vector<TetGradients>& gradients, const Multigrid& guide, Numbers u, Numbers v,
                            std::size_t most_steps) {
  const FoldoverEnergy energy(tets, system, gradients);
  GuidedDescent descent(guide);
  Numbers x = std::move(u);
  x.insert(x.end(), v.begin(), v.end());
  UntangledPlan result;
  result.smallest_determinant = energy.smallest_determinant(x);
  constexpr std::size_t steps_each = 12;      // before ε is chosen anew
  constexpr std::size_t most_slow_rounds = 12;  // something stays turned over for good
  constexpr double good_ratio = 1e-2;         // the same, once nothing is turned over
  constexpr double slow_ratio = 1e-3;         // of the energy in these steps: enough, once nothing is turned over
  double last_length = 1, last_epsilon = 0.3;
  std::size_t slow_rounds = 0;
  while (result.steps < most_steps) {
    const double low = std::min(0.0, result.smallest_determinant);
    // Never larger than before: one sliver far inside out must not blur the barriers of all others.
    const double epsilon = std::min(last_epsilon, std::sqrt(1e-12 + 0.04 * low * low));
    Numbers gradient;
    double value = energy(x, epsilon, gradient);
    const double before = value;
    if (epsilon < 0.5 * last_epsilon) descent.forget();  // another energy
    last_epsilon = epsilon;
    bool is_stuck = false;
    for (std::size_t i = 0; i < steps_each && result.steps < most_steps && !is_stuck; ++i) {
      const Numbers direction = descent.direction(gradient);
      const double slope = inner(direction, gradient);
      if (!(slope < 0)) break;
      // The linear guide alone knows nothing of how steep the barriers are: begin with what went well before.
      double length = descent.knows_nothing() ? std::min(1.0, 4 * last_length) : 1;
      Numbers trial(x.size()), trial_gradient;
      is_stuck = true;
      for (int tries = 0; tries < 25; ++tries) {
        for (std::size_t j = 0; j < x.size(); ++j) trial[j] = x[j] + length * direction[j];
        const double reached = energy(trial, epsilon, trial_gradient);
        if (!(reached <= value + 1e-4 * length * slope)) {
          // To where a parabola through what is known is lowest.
          const double share = -0.5 * slope * length / (reached - value - slope * length);
          length *= share >= 0.1 ? std::min(share, 0.5) : 0.1;
          continue;
        }
        Numbers change(x.size()), step(x.size());
        for (std::size_t j = 0; j < x.size(); ++j) {
          step[j] = trial[j] - x[j];
          change[j] = trial_gradient[j] - gradient[j];
        }
        descent.remember(std::move(step), std::move(change));
        x.swap(trial);
        gradient.swap(trial_gradient);
        value = reached;
        is_stuck = false;
        break;
      }
      last_length = std::max(length, 1e-6);
      ++result.steps;
    }
    result.smallest_determinant = energy.smallest_determinant(x);
    if (result.smallest_determinant > 0 && !(before - value > good_ratio * before)) break;
    slow_rounds = before - value > slow_ratio * before ? 0 : slow_rounds + 1;
    if (slow_rounds >= most_slow_rounds) break;
    if (slow_rounds > 0) last_epsilon *= 0.5;  // sharper barriers for what is left
  }
  result.is_free_of_foldovers = result.smallest_determinant > 0;
  result.u.assign(x.begin(), x.begin() + system.unknown_count);
  result.v.assign(x.begin() + system.unknown_count, x.end());
  return result;
}

}  // namespace strataflow
