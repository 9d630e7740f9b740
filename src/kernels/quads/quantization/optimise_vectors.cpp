#include "kernels/quads/quantization/optimise_vectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "kernels/quads/quantization/close_vectors.h"

namespace strataflow {
namespace {

constexpr std::uint32_t outside = FlatMesh::outside;
constexpr double goal_weight = 16;

GaussianInteger direction(int a, std::int64_t length = 1) { return turned(GaussianInteger{length, 0}, a); }

double along(std::complex<double> z, int a) {
  switch (a & 3) {
    case 0:
      return z.real();
    case 1:
      return z.imag();
    case 2:
      return -z.real();
    default:
      return -z.imag();
  }
}

std::complex<double> as_complex(GaussianInteger z) { return {static_cast<double>(z.re), static_cast<double>(z.im)}; }

/// 1 / |ω_sub|², of the map itself: a goal may have made the wanted vector zero.
double energy_weight(const VectorTargets& targets, std::uint32_t h) {
  return 1 / std::max(std::norm(targets.map[h]), 1e-30);
}

/// Integer vectors under optimisation. Nodes of the graph G' (S41): 4·h + a adds i^a to half-edge h on leaving its
/// triangle; 4·H + 4·j + a takes i^a from the j-th boundary half-edge on entering there; the last one is the outside.
class Descent {
 public:
  Descent(const FlatMesh& mesh, const VectorTargets& targets) : mesh_(mesh), targets_(targets) {
    const std::uint32_t count = mesh.half_edge_count();
    weight_.resize(count);
    for (std::uint32_t h = 0; h < count; ++h) {
      weight_[h] = energy_weight(targets, h);
      if (mesh.opposite[h] == outside) boundary_.push_back(h);
    }
    std::uint32_t points = 0;
    for (const std::uint32_t p : mesh.origin) points = std::max(points, p + 1);
    quarters_.assign(points, 0);
    is_loose_.assign(points, 0);
    for (std::uint32_t h = 0; h < count; ++h) {
      quarters_[mesh.origin[h]] += mesh.corner_quarters(h);
      // Where a boundary is free, or does not follow its axis yet, quarters may change by rounding.
      if (mesh.opposite[h] == outside && !follows(mesh.axis[h], mesh.vector[h]))
        is_loose_[mesh.origin[h]] = is_loose_[mesh.end(h)] = 1;
    }
    nodes_ = 4 * count + 4 * static_cast<std::uint32_t>(boundary_.size()) + 1;
    // What each search looked at, one bit a triangle; without it beyond 64 MB.
    words_ = (count / 3 + 63) / 64;
    if (words_ * 4 * count > (std::size_t{1} << 23)) words_ = 0;
    looked_at_.assign(words_ * 4 * count, 0);
    seen_.assign(nodes_, 0);
    is_settled_.assign(nodes_, 0);
    cost_.resize(nodes_);
    parent_.resize(nodes_);
    touched_round_.assign(count / 3, 0);
    turn_points_.assign(points, 0);
  }

  bool start(IntegerVectors& result) {
    double longest = 1;
    for (std::uint32_t h = 0; h < weight_.size(); ++h)
      longest = std::max({longest, std::abs(targets_.wanted[h]), std::abs(targets_.map[h])});
    // With goals first; they may contradict each other at any scale, the map itself does not.
    for (const bool with_goals : {true, false})
      for (int n = 0; std::ldexp(longest, n) < 0x1.0p55 && (n <= 14 || !with_goals); ++n)
        for (const bool lock_all : {true, false}) {
          if (lock_all && !with_goals) continue;
          round_to(std::ldexp(1.0, n), with_goals);
          lock(lock_all);
          if (!close_vectors(mesh_, fixed_, vectors_) || !is_valid()) continue;
          lock(true);
          result.doublings = n;
          return true;
        }
    return false;
  }

  void run(IntegerVectors& result) {
    result.energy_before = vector_energy(mesh_, targets_, vectors_);
    for (int n = result.doublings; n >= 0; --n) {
      step_ = std::int64_t{1} << n;
      price_everything();
      const std::uint64_t most = 200ull * weight_.size() + 1000;
      for (std::uint64_t round = 0; round < most; ++round)
        if (!descend() && !cancel_negative_cycle()) break;
    }
    result.operations = operations_;
    result.searches = searches_;
  }

  void finish(IntegerVectors& result) const {
    result.energy = vector_energy(mesh_, targets_, vectors_);
    result.vectors = vectors_;
    for (std::uint32_t h = 0; h < weight_.size(); ++h)
      if (targets_.goals[h] & ~met(h)) result.unmet.push_back(h);
  }

 private:
  /// Length of a walk, lexicographic (S41). Turns that spoil a triangle are left out instead of being priced by 1/eps²:
  /// a later pass that would mend the triangle was never worth it.
  struct Cost {
    double loss = 0;  // energy lost
    double rest = 0;  // small positive amounts for steps that gain
    friend bool operator<(const Cost& a, const Cost& b) {
      if (a.loss != b.loss) return a.loss < b.loss;
      return a.rest < b.rest;
    }
  };
  struct Entry {
    Cost cost;
    std::uint32_t node;
    friend bool operator<(const Entry& a, const Entry& b) {  // for a heap with the least on top
      if (a.cost < b.cost) return false;
      if (b.cost < a.cost) return true;
      return a.node > b.node;
    }
  };

  static bool follows(MapAxis axis, GaussianInteger v) {
    return axis == MapAxis::real ? v.im == 0 : axis == MapAxis::imaginary && v.re == 0;
  }
  std::uint32_t first_entry() const { return 4 * static_cast<std::uint32_t>(weight_.size()); }
  std::uint32_t outside_node() const { return nodes_ - 1; }

  bool is_short(std::uint32_t h, GaussianInteger v) const {
    return targets_.least[h] > 1 && std::abs(v.re) + std::abs(v.im) < targets_.least[h];
  }

  /// Goals that hold.
  std::uint8_t met(std::uint32_t h) const {
    return static_cast<std::uint8_t>((vectors_[h].re == targets_.goal[h].re ? fixed_real : 0) |
                                     (vectors_[h].im == targets_.goal[h].im ? fixed_imaginary : 0));
  }

  void round_to(double scale, bool with_goals) {
    vectors_.resize(weight_.size());
    for (std::uint32_t h = 0; h < weight_.size(); ++h) {
      const std::uint32_t other = mesh_.opposite[h];
      if (other != outside && other < h) continue;
      const std::complex<double> z = scale * (with_goals ? targets_.wanted[h] : targets_.map[h]);
      GaussianInteger& v = vectors_[h];
      v = {std::llround(z.real()), std::llround(z.imag())};
      if (is_short(h, v)) {
        if (std::abs(z.real()) >= std::abs(z.imag()))
          v.re = z.real() < 0 ? -targets_.least[h] : targets_.least[h];
        else
          v.im = z.imag() < 0 ? -targets_.least[h] : targets_.least[h];
      }
      if (v == GaussianInteger{}) {  // the nearest that is not zero
        if (std::abs(z.real()) >= std::abs(z.imag()))
          v.re = z.real() < 0 ? -1 : 1;
        else
          v.im = z.imag() < 0 ? -1 : 1;
      }
      if (other != outside) vectors_[other] = -turned(v, mesh_.turns[other]);
    }
  }

  /// Fixes goals that hold: all of them, or only those that the map itself respects.
  void lock(bool all) {
    fixed_.assign(weight_.size(), 0);
    for (std::uint32_t h = 0; h < weight_.size(); ++h)
      if (all || follows(mesh_.axis[h], mesh_.vector[h])) fixed_[h] = targets_.goals[h] & met(h);
  }

  bool is_valid() const {
    std::vector<std::int32_t> quarters(quarters_.size(), 0);
    for (std::uint32_t t = 0; 3 * t < weight_.size(); ++t) {
      if (cross_sign(vectors_[3 * t], vectors_[3 * t + 1]) <= 0) return false;
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        quarters[mesh_.origin[h]] += quarters_at(h);
        if (is_short(h, vectors_[h])) return false;
      }
    }
    for (std::size_t p = 0; p < quarters.size(); ++p)
      if (!is_loose_[p] && quarters[p] != quarters_[p]) return false;
    for (std::uint32_t h = 0; h < weight_.size(); ++h)
      if (follows(mesh_.axis[h], mesh_.vector[h]) && quadrant(vectors_[h]) != quadrant(mesh_.vector[h])) return false;
    return true;
  }
  int quarters_at(std::uint32_t h) const {
    return (quadrant(-vectors_[FlatMesh::before(h)]) - quadrant(vectors_[h])) & 3;
  }

  // ---- prices

  /// Energy change of one step along i^a at h (and its opposite).
  double price(std::uint32_t h, int a) const {
    const double s = static_cast<double>(step_);
    const bool has_goal = !may_change(targets_.goals[h], a);
    return (mesh_.opposite[h] == outside ? 1 : 2) * (has_goal ? goal_weight : 1) * weight_[h] * s *
           (s - 2 * delta(h, a));
  }
  double delta(std::uint32_t h, int a) const { return along(targets_.wanted[h] - as_complex(vectors_[h]), a); }

  /// Price, and what a step that gains counts among walks of equal loss: less the more it gains (S41).
  void set_price(std::uint32_t node, std::uint32_t h, int a) {
    price_[node] = price(h, a);
    rest_[node] = 1 / (0.5 + delta(h, a) / static_cast<double>(step_));
  }

  void price_triangle(std::uint32_t t) {
    for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h)
      for (int a = 0; a < 4; ++a) {
        set_price(4 * h + a, h, a);
        for (int k = 0; k < 2; ++k) {  // entering by the next half-edge, or the one before
          const std::uint32_t g = k == 0 ? FlatMesh::next(h) : FlatMesh::before(h);
          const GaussianInteger out = vectors_[h] + direction(a, step_), in = vectors_[g] - direction(a, step_);
          spoils_[8 * h + 2 * a + k] =
              (k == 0 ? cross_sign(out, in) : cross_sign(in, out)) <= 0 || is_short(h, out) || is_short(g, in);
        }
      }
  }

  void price_everything() {
    is_fruitless_.assign(first_entry(), 0);
    price_.assign(nodes_, 0);
    rest_.assign(nodes_, 0);
    spoils_.assign(8 * weight_.size(), 0);
    for (std::uint32_t t = 0; 3 * t < weight_.size(); ++t) price_triangle(t);
    for (std::uint32_t j = 0; j < boundary_.size(); ++j) price_entry(j);
    price_gains();
  }
  void price_entry(std::uint32_t j) {
    for (int a = 0; a < 4; ++a) set_price(first_entry() + 4 * j + a, boundary_[j], a + 2);
  }
  /// All that could be gained at once: a path that loses more cannot pay.
  void price_gains() {
    all_gains_ = 0;
    for (std::uint32_t h = 0; h < weight_.size(); ++h) all_gains_ += gains(h);
  }
  /// Each side of an edge counts half: it is one step, seen from two sides.
  double gains(std::uint32_t h) const {
    double sum = 0;
    for (int a = 0; a < 4; ++a)
      if (may_change(fixed_[h], a)) sum += std::max(0.0, -price_[4 * h + a]);
    return (mesh_.opposite[h] == outside ? 1.0 : 0.5 + 1e-6) * sum;
  }

  // ---- the graph

  /// Calls visit(node) for each successor whose turn leaves the triangle positive.
  template <class Visit>
  void for_each_successor(std::uint32_t node, Visit visit) const {
    const std::uint32_t entries = first_entry();
    if (node == outside_node()) {
      for (std::uint32_t j = 0; j < boundary_.size(); ++j)
        for (int a = 0; a < 4; ++a)
          if (may_change(fixed_[boundary_[j]], a)) visit(entries + 4 * j + a);
      return;
    }
    std::uint32_t entered, a;
    if (node < entries) {
      entered = mesh_.opposite[node / 4];
      if (entered == outside) {
        visit(outside_node());
        return;
      }
      a = (node - mesh_.turns[node / 4]) & 3u;
    } else {
      entered = boundary_[(node - entries) / 4];
      a = node & 3u;
    }
    const std::uint32_t left = FlatMesh::before(entered), right = FlatMesh::next(entered);
    if (may_change(fixed_[left], static_cast<int>(a)) && !spoils_[8 * left + 2 * a]) visit(4 * left + a);
    if (may_change(fixed_[right], static_cast<int>(a)) && !spoils_[8 * right + 2 * a + 1]) visit(4 * right + a);
  }

  /// Shortest closed walk through `source`, as nodes; empty if there is none worth it.
  void find_operation(std::uint32_t source, std::vector<std::uint32_t>& walk) {
    // A walk that loses more than all that can be gained does not pay. Four times what its start gains is bound enough:
    // walks with more gains than that are left to cancel_negative_cycle.
    const double most_loss = std::min(all_gains_, -4 * price_[source]);
    ++searches_;
    ++round_;
    heap_.clear();
    walk.clear();
    const auto relax = [&](std::uint32_t from, const Cost& cost) {
      for_each_successor(from, [&](std::uint32_t to) {
        Cost reached = cost;
        if (price_[to] < 0)
          reached.rest += rest_[to];
        else
          reached.loss += price_[to];
        if (reached.loss >= most_loss) return;
        if (seen_[to] == round_ && (is_settled_[to] == round_ || !(reached < cost_[to]))) return;
        seen_[to] = round_;
        cost_[to] = reached;
        parent_[to] = from;
        heap_.push_back({reached, to});
        std::push_heap(heap_.begin(), heap_.end());
      });
    };
    std::uint64_t* const looked_at = words_ == 0 ? nullptr : looked_at_.data() + std::size_t{source} * words_;
    if (looked_at != nullptr) std::fill(looked_at, looked_at + words_, 0);
    const auto look = [&](std::uint32_t node) {
      if (looked_at == nullptr) return;
      if (node == outside_node()) {
        std::fill(looked_at, looked_at + words_, ~std::uint64_t{0});
        return;
      }
      const std::uint32_t h = node < first_entry() ? mesh_.opposite[node / 4] : boundary_[(node - first_entry()) / 4];
      if (h != outside) looked_at[h / 192] |= std::uint64_t{1} << (h / 3 % 64);
    };
    if (looked_at != nullptr) looked_at[source / 768] |= std::uint64_t{1} << (source / 12 % 64);
    look(source);
    relax(source, {});
    while (!heap_.empty()) {
      std::pop_heap(heap_.begin(), heap_.end());
      const Entry top = heap_.back();
      heap_.pop_back();
      if (is_settled_[top.node] == round_ || cost_[top.node] < top.cost) continue;
      is_settled_[top.node] = round_;
      if (top.node == source) {
        for (std::uint32_t node = source;;) {
          walk.push_back(node);
          node = parent_[node];
          if (node == source) break;
        }
        return;
      }
      look(top.node);
      relax(top.node, top.cost);
    }
  }

  /// Searches that saw a triangle that has changed since may now find something.
  void wake_searches() {
    if (words_ == 0) return;
    changed_.assign(words_, 0);
    for (const std::uint32_t t : touched_) changed_[t / 64] |= std::uint64_t{1} << (t % 64);
    for (std::uint32_t node = 0; node < is_fruitless_.size(); ++node) {
      if (!is_fruitless_[node]) continue;
      const std::uint64_t* const looked_at = looked_at_.data() + std::size_t{node} * words_;
      for (std::size_t w = 0; w < words_; ++w)
        if (looked_at[w] & changed_[w]) {
          is_fruitless_[node] = 0;
          break;
        }
    }
  }

  void edit(std::uint32_t node, int sign) {
    if (node == outside_node()) return;
    if (node >= first_entry()) {
      const std::uint32_t h = boundary_[(node - first_entry()) / 4];
      vectors_[h] = vectors_[h] - direction(static_cast<int>(node & 3), sign * step_);
      return;
    }
    const std::uint32_t h = node / 4, other = mesh_.opposite[h];
    vectors_[h] = vectors_[h] + direction(static_cast<int>(node & 3), sign * step_);
    if (other != outside)
      vectors_[other] = vectors_[other] - direction(static_cast<int>(node & 3) - mesh_.turns[h], sign * step_);
  }

  /// Applies a closed walk if it lowers the energy and leaves everything valid.
  bool apply(const std::vector<std::uint32_t>& walk) {
    double change = 0, size = 0;
    touched_.clear();
    ++touch_;
    const auto touch = [&](std::uint32_t h) {
      if (touched_round_[h / 3] == touch_) return;
      touched_round_[h / 3] = touch_;
      touched_.push_back(h / 3);
    };
    for (const std::uint32_t node : walk) {
      if (node == outside_node()) continue;
      if (node >= first_entry()) {
        touch(boundary_[(node - first_entry()) / 4]);
      } else {
        touch(node / 4);
        if (mesh_.opposite[node / 4] != outside) touch(mesh_.opposite[node / 4]);
      }
    }
    const auto add_quarters = [&](int sign) {
      for (const std::uint32_t t : touched_)
        for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) turn_points_[mesh_.origin[h]] += sign * quarters_at(h);
    };
    add_quarters(-1);
    quadrants_.clear();
    for (const std::uint32_t t : touched_)
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h)
        quadrants_.push_back(static_cast<std::uint8_t>(quadrant(vectors_[h])));
    for (const std::uint32_t node : walk) {
      // In this order the price of a second step over the same edge counts what the first one did.
      const double cost = node == outside_node() ? 0
                          : node >= first_entry()
                              ? price(boundary_[(node - first_entry()) / 4], static_cast<int>(node & 3) + 2)
                              : price(node / 4, static_cast<int>(node & 3));
      change += cost;
      size += std::abs(cost);
      edit(node, 1);
    }
    add_quarters(1);
    bool is_fine = change < -1e-12 * size;
    for (const std::uint32_t t : touched_) is_fine = is_fine && cross_sign(vectors_[3 * t], vectors_[3 * t + 1]) > 0;
    std::size_t k = 0;
    for (const std::uint32_t t : touched_)
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h, ++k) {
        const std::uint32_t p = mesh_.origin[h];
        is_fine = is_fine && (turn_points_[p] == 0 || is_loose_[p]) && !is_short(h, vectors_[h]);
        // A feature that follows its axis must not turn back on itself.
        if (fixed_[h] != 0 && follows(mesh_.axis[h], vectors_[h]))
          is_fine = is_fine && quadrant(vectors_[h]) == quadrants_[k];
      }
    for (const std::uint32_t t : touched_)
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) turn_points_[mesh_.origin[h]] = 0;
    if (!is_fine) {
      for (const std::uint32_t node : walk) edit(node, -1);
      return false;
    }
    ++operations_;
    for (const std::uint32_t t : touched_) {
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        all_gains_ -= gains(h);
        fixed_[h] |= targets_.goals[h] & met(h);
      }
      price_triangle(t);
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) all_gains_ += gains(h);
    }
    for (std::uint32_t j = 0; j < boundary_.size(); ++j)
      if (touched_round_[boundary_[j] / 3] == touch_) price_entry(j);
    wake_searches();
    return true;
  }

  /// Searches from each half-edge and direction that gains until a whole round finds nothing.
  bool descend() {
    price_gains();
    bool has_changed = false;
    std::vector<std::uint32_t> walk;
    std::uint32_t fruitless = 0;
    const std::uint32_t count = first_entry();
    for (std::uint32_t node = 0; fruitless < count; node = node + 1 == count ? 0 : node + 1) {
      ++fruitless;
      const std::uint32_t h = node / 4, other = mesh_.opposite[h];
      if ((other != outside && other < h) || !may_change(fixed_[h], static_cast<int>(node & 3)) || price_[node] >= 0)
        continue;
      if (is_fruitless_[node]) continue;
      find_operation(node, walk);
      if (walk.empty() || !apply(walk)) {
        is_fruitless_[node] = words_ != 0;
        continue;
      }
      has_changed = true;
      fruitless = 0;
    }
    return has_changed;
  }

  /// Looks for any closed walk over valid turns that lowers the energy, by Bellman and Ford on the true prices.
  bool cancel_negative_cycle() {
    std::vector<std::uint8_t> is_banned(nodes_, 0);
    std::vector<std::uint32_t> walk, mark(nodes_);
    for (int tries = 0; tries < 40; ++tries) {
      distance_.assign(nodes_, 0);
      parent_.assign(nodes_, outside);
      walk.clear();
      for (int round = 0; round < 200 && walk.empty(); ++round) {
        bool has_changed = false;
        for (std::uint32_t node = 0; node < nodes_; ++node) {
          if (is_banned[node] || (distance_[node] == 0 && round > 0 && parent_[node] == outside)) continue;
          for_each_successor(node, [&](std::uint32_t to) {
            if (is_banned[to]) return;
            const double reached = distance_[node] + price_[to];
            if (!(reached < distance_[to] - 1e-12 * (1 + std::abs(distance_[to])))) return;
            distance_[to] = reached;
            parent_[to] = node;
            has_changed = true;
          });
        }
        if (!has_changed) return false;
        // A cycle among the parents has negative length.
        std::fill(mark.begin(), mark.end(), outside);
        for (std::uint32_t start = 0; start < nodes_ && walk.empty(); ++start) {
          std::uint32_t node = start;
          while (node != outside && mark[node] == outside) {
            mark[node] = start;
            node = parent_[node];
          }
          if (node == outside || mark[node] != start) continue;
          const std::uint32_t end = node;
          do {
            walk.push_back(node);
            node = parent_[node];
          } while (node != end);
        }
      }
      if (walk.empty()) return false;
      ++searches_;
      if (apply(walk)) return true;
      is_banned[*std::max_element(walk.begin(), walk.end())] = 1;
    }
    return false;
  }

  const FlatMesh& mesh_;
  const VectorTargets& targets_;
  std::vector<GaussianInteger> vectors_;
  std::vector<std::uint8_t> fixed_;      // per half-edge
  std::vector<double> weight_;           // per half-edge: 1 / |ω_sub|²
  std::vector<std::uint32_t> boundary_;  // boundary half-edges
  std::vector<std::int32_t> quarters_;   // per point, of the map
  std::vector<std::uint8_t> is_loose_;   // per point: quarters may change
  std::int64_t step_ = 1;
  std::uint32_t nodes_ = 0, round_ = 0, operations_ = 0, touch_ = 0;
  std::uint64_t searches_ = 0;
  double all_gains_ = 0;
  std::vector<double> price_, rest_;  // per node
  std::vector<std::uint8_t> spoils_;  // per half-edge, direction and side entered by
  std::vector<std::uint32_t> seen_, is_settled_, parent_, touched_, touched_round_;
  std::vector<std::int32_t> turn_points_;
  std::vector<std::uint8_t> quadrants_;
  std::vector<Cost> cost_;
  std::vector<double> distance_;
  std::vector<Entry> heap_;
  std::size_t words_ = 0;
  std::vector<std::uint64_t> looked_at_, changed_;  // per node 4·h + a: triangles, as bits
  std::vector<std::uint8_t> is_fruitless_;          // per node: searched, and nothing it saw has changed
};

}  // namespace

VectorTargets targets_of(const FlatMesh& mesh, double quads_per_unit) {
  VectorTargets targets;
  const std::uint32_t count = mesh.half_edge_count();
  targets.map.resize(count);
  targets.wanted.resize(count);
  targets.goals.assign(count, 0);
  targets.goal.assign(count, {});
  targets.least.assign(count, 1);
  std::vector<std::array<std::uint32_t, 3>> features;  // ends and half-edge
  for (std::uint32_t h = 0; h < count; ++h) {
    targets.map[h] = targets.wanted[h] = as_complex(mesh.vector[h]) * (mesh.step * quads_per_unit);
    if (mesh.axis[h] == MapAxis::real) {
      targets.goals[h] = fixed_imaginary;
      targets.wanted[h].imag(0);
    } else if (mesh.axis[h] == MapAxis::imaginary) {
      targets.goals[h] = fixed_real;
      targets.wanted[h].real(0);
    }
    const std::uint32_t a = mesh.origin[h], b = mesh.end(h);
    if (mesh.axis[h] != MapAxis::none && (mesh.opposite[h] == outside || h < mesh.opposite[h]))
      features.push_back({std::min(a, b), std::max(a, b), h});
  }
  std::sort(features.begin(), features.end());
  for (std::size_t k = 0, next = 0; k < features.size(); k = next) {
    std::size_t shortest = k;
    for (next = k; next < features.size() && features[next][0] == features[k][0] && features[next][1] == features[k][1];
         ++next)
      if (std::norm(targets.map[features[next][2]]) < std::norm(targets.map[features[shortest][2]])) shortest = next;
    for (std::size_t i = k; i < next; ++i) {
      const std::uint32_t h = features[i][2];
      targets.least[h] = features[k][0] == features[k][1] ? 3 : i == shortest ? 1 : 2;
      if (mesh.opposite[h] != outside) targets.least[mesh.opposite[h]] = targets.least[h];
    }
  }
  return targets;
}

double vector_energy(const FlatMesh& mesh, const VectorTargets& targets, const std::vector<GaussianInteger>& vectors) {
  double energy = 0;
  for (std::uint32_t h = 0; h < mesh.half_edge_count(); ++h) {
    const std::complex<double> off = as_complex(vectors[h]) - targets.wanted[h];
    const double re = (targets.goals[h] & fixed_real ? goal_weight : 1) * off.real() * off.real();
    const double im = (targets.goals[h] & fixed_imaginary ? goal_weight : 1) * off.imag() * off.imag();
    energy += (re + im) * energy_weight(targets, h);
  }
  return energy;
}

Result<IntegerVectors> optimise_vectors(const FlatMesh& mesh, const VectorTargets& targets,
                                        const OptimiseOptions& options) {
  IntegerVectors result;
  Descent descent(mesh, targets);
  if (!descent.start(result))
    return Failure{FailureCode::geometry_failed, "no multiple of the map has valid integer vectors",
                   "give the features more room, or a finer edge length"};
  if (!options.only_start) descent.run(result);
  descent.finish(result);
  return result;
}

}  // namespace strataflow
