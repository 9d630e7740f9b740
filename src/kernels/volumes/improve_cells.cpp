#include "kernels/volumes/improve_cells.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "base/id.h"

namespace strataflow {

namespace {

constexpr int rounds = 6;
constexpr double least_kept = 1e-6;  ///< far above rounding: what is made is certainly positive
constexpr std::size_t longest_ring = 8;

double scaled_jacobian(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double ab = length(b - a), ac = length(c - a), ad = length(d - a);
  const double bc = length(c - b), bd = length(d - b), cd = length(d - c);
  const double most = std::max({ab * ac * ad, ab * bc * bd, ac * bc * cd, ad * bd * cd});
  return most > 0 ? std::sqrt(2.0) * dot(cross(b - a, c - a), d - a) / most : 0;
}

/// The sine of the dihedral angle at an edge: 3/2 volume times edge over the areas of the two faces beside it.
double smallest_sine(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const double six_volumes = dot(cross(b - a, c - a), d - a);
  const double abc = length(cross(b - a, c - a)), abd = length(cross(b - a, d - a));
  const double acd = length(cross(c - a, d - a)), bcd = length(cross(c - b, d - b));
  const double least =
      std::min({length(b - a) / (abc * abd), length(c - a) / (abc * acd), length(d - a) / (abd * acd),
                length(c - b) / (abc * bcd), length(d - b) / (abd * bcd), length(d - c) / (acd * bcd)});
  return abc > 0 && abd > 0 && acd > 0 && bcd > 0 ? six_volumes * least : 0;
}

class Improver {
 public:
  explicit Improver(ImprovableCells& cells)
      : points_(cells.points),
        is_free_(cells.is_free),
        tets_(cells.tets),
        measure_(cells.measure),
        good_enough_(cells.good_enough),
        worth_a_point_(cells.worth_a_point),
        worst_kept_at_(cells.worst_kept_at) {
    facets_ = cells.facets;
    for (Triangle& facet : facets_) {
      std::sort(facet.begin(), facet.end());
      for (const auto& [i, j] : {std::pair{0, 1}, {0, 2}, {1, 2}}) facet_edges_.push_back({facet[i], facet[j]});
    }
    std::sort(facets_.begin(), facets_.end());
    std::sort(facet_edges_.begin(), facet_edges_.end());
    tets_of_.resize(points_.size());
    is_alive_.assign(tets_.size(), 1);
    for (std::uint32_t t = 0; t < tets_.size(); ++t) {
      quality_.push_back(quality_of(tets_[t]));
      for (const std::uint32_t v : tets_[t]) tets_of_[v].push_back(t);
    }
  }

  CellImprovement improve() {
    done_.smallest_before = smallest();
    for (int round = 0; round < rounds; ++round) {
      const std::uint64_t before = done_.exchanges + done_.moves + done_.added_points;
      for (const std::uint32_t t : worst_first(good_enough_))
        if (is_alive_[t]) take_out_edge(t) || take_out_face(t);
      for (std::uint32_t v = 0; v < points_.size(); ++v)
        if (is_free_[v]) move(v);
      for (const std::uint32_t t : worst_first(worth_a_point_))
        if (is_alive_[t] && round > 0) add_point(t);
      if (before == done_.exchanges + done_.moves + done_.added_points) break;
    }
    done_.smallest_after = smallest();
    std::size_t end = 0;
    for (std::size_t t = 0; t < tets_.size(); ++t)
      if (is_alive_[t]) tets_[end++] = tets_[t];
    tets_.resize(end);
    return done_;
  }

 private:
  double quality_of(const Tet& t) const {
    const auto measure = measure_ == TetMeasure::smallest_sine ? smallest_sine : scaled_jacobian;
    return measure(points_[t[0]], points_[t[1]], points_[t[2]], points_[t[3]]);
  }
  double worst_kept_at(std::uint32_t v) const { return worst_kept_at_ ? worst_kept_at_(v, points_) : 1; }
  double smallest() const {
    double least = 1;
    for (std::size_t t = 0; t < tets_.size(); ++t)
      if (is_alive_[t]) least = std::min(least, quality_[t]);
    for (std::uint32_t v = 0; v < points_.size(); ++v)
      if (is_free_[v]) least = std::min(least, worst_kept_at(v));
    return least;
  }
  std::vector<std::uint32_t> worst_first(double below) const {
    std::vector<std::uint32_t> worst;
    for (std::uint32_t t = 0; t < tets_.size(); ++t)
      if (is_alive_[t] && quality_[t] < below) worst.push_back(t);
    std::sort(worst.begin(), worst.end(), [&](std::uint32_t a, std::uint32_t b) {
      return quality_[a] != quality_[b] ? quality_[a] < quality_[b] : a < b;
    });
    return worst;
  }
  bool is_facet(Triangle face) const {
    std::sort(face.begin(), face.end());
    return std::binary_search(facets_.begin(), facets_.end(), face);
  }
  bool is_on_facet(std::uint32_t a, std::uint32_t b) const {
    return std::binary_search(facet_edges_.begin(), facet_edges_.end(), std::array{std::min(a, b), std::max(a, b)});
  }

  void remove(std::uint32_t t) {
    is_alive_[t] = 0;
    for (const std::uint32_t v : tets_[t]) std::erase(tets_of_[v], t);
  }
  void add(const Tet& tet) {
    const auto t = static_cast<std::uint32_t>(tets_.size());
    tets_.push_back(tet);
    is_alive_.push_back(1);
    quality_.push_back(quality_of(tet));
    for (const std::uint32_t v : tet) tets_of_[v].push_back(t);
  }
  void replace(std::span<const std::uint32_t> old, std::span<const Tet> made) {
    for (const std::uint32_t t : old) remove(t);
    for (const Tet& tet : made) add(tet);
  }

  /// The tetrahedra around an edge inside and their corners off it, in turn: positive tetrahedra are
  /// {a, b, corner[i], corner[i + 1]}.
  struct Ring {
    std::vector<std::uint32_t> tets, corners;
    double quality = 1;
  };
  std::optional<Ring> ring_of(std::uint32_t a, std::uint32_t b) const {
    if (is_on_facet(a, b)) return std::nullopt;
    Ring ring;
    std::vector<std::array<std::uint32_t, 2>> steps;
    for (const std::uint32_t t : tets_of_[a]) {
      const Tet& tet = tets_[t];
      if (std::find(tet.begin(), tet.end(), b) == tet.end()) continue;
      ring.tets.push_back(t);
      ring.quality = std::min(ring.quality, quality_[t]);
      std::array<std::uint32_t, 2> step{};
      std::size_t filled = 0;
      for (const std::uint32_t v : tet)
        if (v != a && v != b) step[filled++] = v;
      if (is_odd(tet, {a, b, step[0], step[1]})) std::swap(step[0], step[1]);
      steps.push_back(step);
    }
    if (steps.size() < 3 || steps.size() > longest_ring) return std::nullopt;
    ring.corners.push_back(steps[0][0]);
    for (std::uint32_t next = steps[0][1]; next != ring.corners[0];) {
      ring.corners.push_back(next);
      const auto step = std::find_if(steps.begin(), steps.end(), [&](const auto& s) { return s[0] == next; });
      if (step == steps.end() || ring.corners.size() > steps.size()) return std::nullopt;
      next = (*step)[1];
    }
    if (ring.corners.size() != steps.size()) return std::nullopt;
    return ring;
  }
  /// Whether two orders of the same four vertices turn differently.
  static bool is_odd(const Tet& from, const Tet& to) {
    std::array<std::size_t, 4> place{};
    for (std::size_t k = 0; k < 4; ++k)
      place[k] = static_cast<std::size_t>(std::find(from.begin(), from.end(), to[k]) - from.begin());
    bool odd = false;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = i + 1; j < 4; ++j) odd ^= place[i] > place[j];
    return odd;
  }

  /// Replaces the ring around one of the edges of t by the best two fans over a triangulation of its corners.
  bool take_out_edge(std::uint32_t t) {
    std::vector<Tet> best;
    std::vector<std::uint32_t> old;
    double best_gain = 0;
    for (const auto& [i, j] : edges) {
      const std::uint32_t a = tets_[t][i], b = tets_[t][j];
      const std::optional<Ring> ring = ring_of(a, b);
      if (!ring) continue;
      const std::size_t n = ring->corners.size();
      // worth[i][k]: of the best triangulation of corners i … k, its worst tetrahedron.
      std::array<std::array<double, longest_ring>, longest_ring> worth{};
      std::array<std::array<std::size_t, longest_ring>, longest_ring> through{};
      for (std::size_t low = 0; low < n; ++low) worth[low][(low + 1) % n] = 1;
      for (std::size_t span = 2; span < n; ++span)
        for (std::size_t low = 0; low + span < n; ++low) {
          const std::size_t high = low + span;
          worth[low][high] = -1;
          for (std::size_t mid = low + 1; mid < high; ++mid) {
            const auto [under, over] = halves(*ring, a, b, low, mid, high);
            const double worst = std::min({quality_of(under), quality_of(over), mid == low + 1 ? 1 : worth[low][mid],
                                           mid + 1 == high ? 1 : worth[mid][high]});
            if (worst <= worth[low][high]) continue;
            worth[low][high] = worst;
            through[low][high] = mid;
          }
        }
      const double worst = worth[0][n - 1];
      if (!(worst > least_kept) || !(worst - ring->quality > std::max(best_gain, 1e-3 * ring->quality))) continue;
      best_gain = worst - ring->quality;
      best.clear();
      old = ring->tets;
      std::vector<std::array<std::size_t, 2>> open{{0, n - 1}};
      while (!open.empty()) {
        const auto [low, high] = open.back();
        open.pop_back();
        if (high - low < 2) continue;
        const std::size_t mid = through[low][high];
        const auto [under, over] = halves(*ring, a, b, low, mid, high);
        best.insert(best.end(), {under, over});
        open.push_back({low, mid});
        open.push_back({mid, high});
      }
    }
    if (best.empty()) return false;
    replace(old, best);
    ++done_.exchanges;
    return true;
  }
  static std::array<Tet, 2> halves(const Ring& ring, std::uint32_t a, std::uint32_t b, std::size_t i, std::size_t j,
                                   std::size_t k) {
    const std::uint32_t p = ring.corners[i], q = ring.corners[j], r = ring.corners[k];
    return {Tet{a, p, q, r}, Tet{p, q, r, b}};
  }

  bool take_out_face(std::uint32_t t) {
    std::array<Tet, 3> best{};
    std::array<std::uint32_t, 2> old{};
    double best_gain = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Tet& own = tets_[t];
      Triangle face{};
      for (std::size_t i = 0, filled = 0; i < 4; ++i)
        if (i != k) face[filled++] = own[i];
      if (is_facet(face)) continue;
      for (const std::uint32_t other : tets_of_[face[0]]) {
        const Tet& beyond = tets_[other];
        const auto has = [&](std::uint32_t v) { return std::find(beyond.begin(), beyond.end(), v) != beyond.end(); };
        if (other == t || !has(face[1]) || !has(face[2])) continue;
        const std::uint32_t far = *std::find_if(beyond.begin(), beyond.end(), [&](std::uint32_t v) {
          return std::find(face.begin(), face.end(), v) == face.end();
        });
        std::array<Tet, 3> made{};
        double worst = 1;
        for (std::size_t i = 0; i < 3; ++i) {
          made[i] = own;
          *std::find(made[i].begin(), made[i].end(), face[i]) = far;
          worst = std::min(worst, quality_of(made[i]));
        }
        const double now = std::min(quality_[t], quality_[other]);
        if (!(worst > least_kept) || !(worst - now > std::max(best_gain, 1e-3 * now))) continue;
        best_gain = worst - now;
        best = made;
        old = {t, other};
      }
    }
    if (!(best_gain > 0)) return false;
    replace(old, best);
    ++done_.exchanges;
    return true;
  }

  double worst_around(std::uint32_t v) const {
    double worst = worst_kept_at(v);
    for (const std::uint32_t t : tets_of_[v]) worst = std::min(worst, quality_of(tets_[t]));
    return worst;
  }

  /// Moves a free point to where its worst cell is better: a search along the axes with halving steps.
  bool move(std::uint32_t v) {
    double now = worst_around(v);
    if (now > good_enough_) return false;
    double step = 0;
    for (const std::uint32_t t : tets_of_[v])
      for (const std::uint32_t w : tets_[t]) step = std::max(step, length(points_[w] - points_[v]));
    bool has_moved = false;
    step *= 0.25;
    for (int tries = 0, halvings = 0; halvings < 6 && tries < 24; ++tries) {
      const Vec3 from = points_[v];
      Vec3 best = from;
      for (const Vec3& direction : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
        for (const double sign : {1.0, -1.0}) {
          points_[v] = from + sign * step * direction;
          const double worst = worst_around(v);
          if (!(worst > now + 1e-3 * std::abs(now)) || !(worst > least_kept)) continue;
          now = worst;
          best = points_[v];
        }
      points_[v] = best;
      if (best == from) {
        step *= 0.5;
        ++halvings;
      } else {
        has_moved = true;
      }
    }
    if (!has_moved) return false;
    for (const std::uint32_t t : tets_of_[v]) quality_[t] = quality_of(tets_[t]);
    ++done_.moves;
    return true;
  }

  /// Sets a free point on the edge of t inside that gains most by it.
  bool add_point(std::uint32_t t) {
    struct Gain {
      double quality = 0;
      Ring ring;
      std::uint32_t a = 0, b = 0;
      Vec3 at;
    } best;
    const auto v = static_cast<std::uint32_t>(points_.size());
    const std::uint64_t moves = done_.moves;  // what is tried does not count
    for (const auto& [i, j] : edges) {
      const std::uint32_t a = tets_[t][i], b = tets_[t][j];
      std::optional<Ring> ring = ring_of(a, b);
      if (!ring) continue;
      insert(*ring, a, b, 0.5 * (points_[a] + points_[b]));
      move(v);
      const double worst = worst_around(v);
      if (worst > least_kept && worst > std::max(best.quality, 1.5 * ring->quality))
        best = {worst, *ring, a, b, points_[v]};
      withdraw(*ring);
    }
    done_.moves = moves;
    if (best.ring.tets.empty()) return false;
    insert(best.ring, best.a, best.b, best.at);
    for (const std::uint32_t old : best.ring.tets) remove(old);
    ++done_.added_points;
    return true;
  }
  /// Tetrahedra with a new point in the place of those of the ring, which stay for now.
  void insert(const Ring& ring, std::uint32_t a, std::uint32_t b, const Vec3& at) {
    const auto v = static_cast<std::uint32_t>(points_.size());
    points_.push_back(at);
    is_free_.push_back(1);
    tets_of_.emplace_back();
    const std::size_t n = ring.corners.size();
    for (std::size_t k = 0; k < n; ++k) {
      add({v, b, ring.corners[k], ring.corners[(k + 1) % n]});
      add({a, v, ring.corners[k], ring.corners[(k + 1) % n]});
    }
  }
  void withdraw(const Ring& ring) {
    for (std::size_t k = 0; k < 2 * ring.corners.size(); ++k) {
      remove(static_cast<std::uint32_t>(tets_.size() - 1));
      tets_.pop_back();
      is_alive_.pop_back();
      quality_.pop_back();
    }
    points_.pop_back();
    is_free_.pop_back();
    tets_of_.pop_back();
  }

  static constexpr std::array<std::array<std::size_t, 2>, 6> edges{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

  std::vector<Vec3>& points_;
  std::vector<char>& is_free_;
  std::vector<Tet>& tets_;
  const TetMeasure measure_;
  const double good_enough_, worth_a_point_;
  const std::function<double(std::uint32_t, const std::vector<Vec3>&)>& worst_kept_at_;
  std::vector<Triangle> facets_;                           ///< ascending, each ascending
  std::vector<std::array<std::uint32_t, 2>> facet_edges_;  ///< ascending
  std::vector<std::vector<std::uint32_t>> tets_of_;        ///< per point
  std::vector<char> is_alive_;
  std::vector<double> quality_;
  CellImprovement done_;
};

}  // namespace

ImprovableCells improvable_cells(const RegionBoundary& boundary, const RegionMesh& mesh) {
  ImprovableCells cells;
  cells.points = points_of(boundary, mesh);
  cells.is_free.assign(boundary.coordinates.size(), 0);
  cells.is_free.resize(cells.points.size(), 1);
  cells.tets = mesh.tets;
  cells.facets = boundary.facets;
  return cells;
}

CellImprovement improve_cells(ImprovableCells& cells) { return Improver(cells).improve(); }

}  // namespace strataflow
