#include "kernels/quads/extraction/smooth_quads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>

#include "base/id.h"
#include "kernels/intersection/bounding_volume_tree.h"
#include "kernels/quads/extraction/check_quads.h"
#include "kernels/quads/extraction/quad_quality.h"
#include "kernels/quads/plan/plane_geometry.h"
#include "kernels/quality/nearest_triangle.h"

namespace strataflow {

namespace {

FloatBox box_of(const Vec3& a, const Vec3& b) {
  Box3 box;
  box.take(a);
  box.take(b);
  return enclosing(box);
}

/// A polyline that points slide on, by arc length.
struct SlidingCurve {
  std::vector<Vec3> points;
  std::vector<double> arc_m;  ///< per point
  bool is_closed = false;

  Vec3 at(double s) const {
    const double whole = arc_m.back();
    if (is_closed) s -= whole * std::floor(s / whole);
    s = std::clamp(s, 0.0, whole);
    auto i = static_cast<std::size_t>(std::upper_bound(arc_m.begin(), arc_m.end(), s) - arc_m.begin());
    i = std::clamp<std::size_t>(i, 1, points.size() - 1);
    const double step = arc_m[i] - arc_m[i - 1];
    return between(points[i - 1], points[i], step > 0 ? (s - arc_m[i - 1]) / step : 0);
  }
};

class QuadSmoother {
 public:
  QuadSmoother(QuadMesh& quads, const FeatureMesh& mesh, const QuadSmoothing& options)
      : quads_(quads), mesh_(mesh), options_(options) {}

  Result<SmoothingReport> run() {
    is_plane_ = std::all_of(mesh_.points.begin(), mesh_.points.end(), [](const Vec3& p) { return p.z == 0; });
    link();
    if (!is_plane_) find_sheets();
    if (const auto failure = find_curves()) return *failure;
    normals_.assign(quads_.quads.size(), {0, 0, 1});
    refresh_normals();
    SmoothingReport report;
    report.before = smallest();
    raise(report);
    report.after = smallest();
    if (report.after < options_.untangle_below) {
      const std::vector<Vec3> points = quads_.points;
      const std::vector<double> arcs = arc_m_;
      untangle(report);
      raise(report);
      const double untangled = smallest();
      if (untangled > report.after) {
        report.after = untangled;
      } else {
        quads_.points = points;
        arc_m_ = arcs;
      }
    }
    return report;
  }

 private:
  enum class Kind : std::uint8_t { fixed, curve, free };
  struct Worth {
    double worst = 1, penalty = 0;
  };

  std::span<const std::uint32_t> quads_around(std::uint32_t p) const {
    return {around_.data() + first_[p], around_.data() + first_[p + 1]};
  }

  void link() {
    first_.assign(quads_.points.size() + 1, 0);
    for (const auto& q : quads_.quads)
      for (const std::uint32_t p : q) ++first_[p + 1];
    for (std::size_t p = 1; p < first_.size(); ++p) first_[p] += first_[p - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    around_.resize(4 * quads_.quads.size());
    for (std::uint32_t q = 0; q < quads_.quads.size(); ++q)
      for (const std::uint32_t p : quads_.quads[q]) around_[next[p]++] = q;
  }

  std::optional<Failure> find_curves() {
    kind_.assign(quads_.points.size(), Kind::free);
    const auto boundary = boundary_points(quads_);
    for (std::size_t p = 0; p < kind_.size(); ++p)
      if (boundary[p]) kind_[p] = Kind::fixed;
    std::vector<std::array<std::uint32_t, 2>> ends(quads_.points.size(), {no_index, no_index});
    std::vector<std::uint8_t> degree(quads_.points.size(), 0);
    for (std::size_t i = 0; i < quads_.edges.size(); ++i) {
      const FeatureEdge& e = quads_.edges[i];
      if (i > 0 && e.a == quads_.edges[i - 1].a && e.b == quads_.edges[i - 1].b) continue;
      for (const auto& [p, other] : {std::pair(e.a, e.b), std::pair(e.b, e.a)}) {
        if (degree[p] < 2) ends[p][degree[p]] = other;
        degree[p] = static_cast<std::uint8_t>(std::min(degree[p] + 1, 3));
        kind_[p] = degree[p] == 2 ? Kind::curve : Kind::fixed;
      }
    }
    for (const std::uint32_t p : quads_.corner_points)
      if (p != no_index) kind_[p] = Kind::fixed;
    beside_ = std::move(ends);
    // Features of the mesh as curves; where several coincide, once.
    std::vector<FeatureEdge> edges;
    for (const FeatureEdge& e : mesh_.edges)
      if (edges.empty() || edges.back().a != e.a || edges.back().b != e.b) edges.push_back({e.a, e.b, 0});
    std::vector<std::array<std::uint32_t, 2>> segments;  // curve, step
    std::vector<FloatBox> boxes;
    for (const auto& chain : feature_chains(edges, mesh_.corners, 0)) {
      SlidingCurve curve;
      curve.is_closed = chain.front() == chain.back();
      for (const std::uint32_t p : chain) {
        const Vec3& x = mesh_.points[p];
        curve.arc_m.push_back(curve.points.empty() ? 0 : curve.arc_m.back() + length(x - curve.points.back()));
        curve.points.push_back(x);
      }
      for (std::uint32_t i = 0; i + 1 < curve.points.size(); ++i) {
        segments.push_back({static_cast<std::uint32_t>(curves_.size()), i});
        boxes.push_back(box_of(curve.points[i], curve.points[i + 1]));
      }
      curves_.push_back(std::move(curve));
    }
    const BoundingVolumeTree tree(boxes);
    curve_of_.assign(quads_.points.size(), no_index);
    arc_m_.assign(quads_.points.size(), 0);
    for (std::uint32_t p = 0; p < kind_.size(); ++p) {
      if (kind_[p] != Kind::curve) continue;
      double best = std::numeric_limits<double>::infinity();
      std::uint32_t found = no_index;
      const Vec3& x = quads_.points[p];
      tree.visit_nearest(x, best, [&](std::uint32_t place) {
        const std::uint32_t s = tree.item_at(place);
        const SlidingCurve& curve = curves_[segments[s][0]];
        const double away = distance_to_segment(x, curve.points[segments[s][1]], curve.points[segments[s][1] + 1]);
        if (away * away < best || (away * away == best && s < found)) {
          best = away * away;
          found = s;
        }
        return best;
      });
      if (found == no_index)
        return Failure{FailureCode::internal_error, "a labelled point of the quads lies on no feature",
                       "report this mesh"};
      const auto& [c, i] = segments[found];
      const SlidingCurve& curve = curves_[c];
      curve_of_[p] = c;
      arc_m_[p] = curve.arc_m[i] +
                  nearest_parameter(x, curve.points[i], curve.points[i + 1]) * (curve.arc_m[i + 1] - curve.arc_m[i]);
    }
    return std::nullopt;
  }

  /// On surfaces quads stay on their side of features: what is nearest may be the other face of a thin blade. Each smooth
  /// patch of quads goes with the patch of triangles that most of its quads are nearest to.
  void find_sheets() {
    const NearestTriangle whole(TriangleMesh{mesh_.points, mesh_.triangles});
    const std::vector<std::uint32_t> of_triangle = smooth_patches(mesh_.triangles, mesh_.edges);
    const std::vector<std::uint32_t> of_quad = smooth_patches(quads_.quads, quads_.edges);
    std::map<std::uint32_t, std::map<std::uint32_t, std::size_t>> votes;
    for (std::size_t q = 0; q < quads_.quads.size(); ++q)
      ++votes[of_quad[q]][of_triangle[whole.nearest(middle(q)).triangle]];
    std::map<std::uint32_t, std::uint32_t> sheet_of;  // patch of triangles → sheet
    const auto take = [&](std::uint32_t patch) {
      const auto [found, is_new] = sheet_of.try_emplace(patch, static_cast<std::uint32_t>(sheets_.size()));
      if (!is_new) return found->second;
      std::vector<std::uint32_t> members;
      std::vector<Triangle> triangles;
      for (std::uint32_t t = 0; t < of_triangle.size(); ++t)
        if (of_triangle[t] == patch) {
          members.push_back(t);
          triangles.push_back(mesh_.triangles[t]);
        }
      sheets_.push_back({NearestTriangle(TriangleMesh{mesh_.points, triangles}), std::move(members)});
      return found->second;
    };
    sheet_.resize(quads_.quads.size());
    std::map<std::uint32_t, std::uint32_t> chosen;
    for (const auto& [patch, found] : votes) {
      const auto most = std::max_element(found.begin(), found.end(),
                                         [](const auto& a, const auto& b) { return a.second < b.second; });
      chosen[patch] = take(most->first);
    }
    for (std::size_t q = 0; q < sheet_.size(); ++q) sheet_[q] = chosen[of_quad[q]];
  }

  Vec3 middle(std::size_t q) const {
    Vec3 sum;
    for (const std::uint32_t p : quads_.quads[q]) sum = sum + 0.25 * quads_.points[p];
    return sum;
  }

  std::uint32_t nearest(const Vec3& p, std::size_t q) const {
    const Sheet& sheet = sheets_[sheet_[q]];
    return sheet.triangles[sheet.nearest.nearest(p).triangle];
  }

  void refresh_normals() {
    if (is_plane_) return;
    for (std::size_t q = 0; q < quads_.quads.size(); ++q) normals_[q] = normal_of(nearest(middle(q), q));
  }

  Vec3 normal_of(std::uint32_t t) const {
    const Triangle& c = mesh_.triangles[t];
    const Vec3 n = cross(mesh_.points[c[1]] - mesh_.points[c[0]], mesh_.points[c[2]] - mesh_.points[c[0]]);
    const double size = length(n);
    return size > 0 ? (1 / size) * n : Vec3{0, 0, 1};
  }

  QuadShape shape(std::uint32_t q) const {
    const auto& c = quads_.quads[q];
    return quad_shape(quads_.points[c[0]], quads_.points[c[1]], quads_.points[c[2]], quads_.points[c[3]], normals_[q]);
  }

  double smallest() const {
    double least = 1;
    for (std::uint32_t q = 0; q < quads_.quads.size(); ++q) least = std::min(least, shape(q).scaled_jacobian);
    return least;
  }

  /// Moves points while the worst quad around them gets better.
  void raise(SmoothingReport& report) {
    std::vector<char> is_active(quads_.points.size(), 1), will_be(quads_.points.size(), 0);
    for (std::int64_t round = 0; round < options_.rounds; ++round) {
      std::uint64_t moved = 0;
      std::fill(will_be.begin(), will_be.end(), 0);
      for (std::uint32_t p = 0; p < quads_.points.size(); ++p) {
        if (!is_active[p] || kind_[p] == Kind::fixed || !improve(p)) continue;
        ++moved;
        for (const std::uint32_t q : quads_around(p))
          for (const std::uint32_t v : quads_.quads[q]) will_be[v] = 1;
      }
      refresh_normals();
      report.moves += moved;
      ++report.rounds;
      is_active.swap(will_be);
      if (moved == 0) break;
    }
  }

  /// Where quads are turned over, moves that make one better make another worse: no step that looks at the worst alone
  /// gets on. A smooth energy with a barrier that is first low, then steep (coudert2024 S44), unfolds them together.
  void untangle(SmoothingReport& report) {
    std::vector<char> is_near(quads_.points.size(), 0);
    for (std::uint32_t q = 0; q < quads_.quads.size(); ++q)
      if (shape(q).scaled_jacobian < options_.untangle_below)
        for (const std::uint32_t p : quads_.quads[q]) is_near[p] = 1;
    constexpr int rings = 4;
    for (int ring = 0; ring < rings; ++ring) {
      const std::vector<char> core = is_near;
      for (const auto& q : quads_.quads)
        if (std::any_of(q.begin(), q.end(), [&](std::uint32_t p) { return core[p] != 0; }))
          for (const std::uint32_t p : q) is_near[p] = 1;
    }
    scale_m2_.assign(quads_.quads.size(), 0);
    for (std::uint32_t q = 0; q < quads_.quads.size(); ++q)
      for (std::size_t k = 0; k < 4; ++k) {
        const Vec3 side = quads_.points[quads_.quads[q][(k + 1) % 4]] - quads_.points[quads_.quads[q][k]];
        scale_m2_[q] += 0.25 * dot(side, side);
      }
    constexpr int sweeps = 8;
    for (const double barrier : {0.5, 0.2, 0.1, 0.05, 0.02, 0.01}) {
      barrier_ = barrier;
      for (int sweep = 0; sweep < sweeps; ++sweep) {
        std::uint64_t moved = 0;
        for (std::uint32_t p = 0; p < quads_.points.size(); ++p)
          if (is_near[p] && kind_[p] != Kind::fixed && improve(p)) ++moved;
        refresh_normals();
        report.moves += moved;
        if (moved == 0) break;
      }
    }
    barrier_ = 0;
  }

  /// Sum over corners of (squared sides)/(twice the area), the area kept positive by the barrier.
  double energy(std::uint32_t q) const {
    const auto& c = quads_.quads[q];
    const double blunt = barrier_ * scale_m2_[q];
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const Vec3& at = quads_.points[c[k]];
      const Vec3 u = quads_.points[c[(k + 1) % 4]] - at, v = quads_.points[c[(k + 3) % 4]] - at;
      const double area = dot(cross(u, v), normals_[q]);
      sum += (dot(u, u) + dot(v, v)) / (area + std::sqrt(area * area + blunt * blunt));
    }
    return sum;
  }

  Worth worth_at(std::uint32_t p, const Vec3& x) {
    const Vec3 before = quads_.points[p];
    quads_.points[p] = x;
    Worth worth;
    for (const std::uint32_t q : quads_around(p)) {
      if (barrier_ > 0) {
        worth.penalty += energy(q);
        continue;
      }
      const QuadShape found = shape(q);
      worth.worst = std::min(worth.worst, found.scaled_jacobian);
      worth.penalty += found.distortion;
    }
    quads_.points[p] = before;
    return worth;
  }

  static bool is_better(const Worth& a, const Worth& b) {
    constexpr double least_gain = 1e-4;
    if (a.worst > b.worst + least_gain) return true;
    return a.worst >= b.worst && a.penalty < b.penalty * (1 - least_gain);
  }

  bool improve(std::uint32_t p) {
    Worth best = worth_at(p, quads_.points[p]);
    if (barrier_ == 0 && best.worst >= options_.good_enough) return false;
    return kind_[p] == Kind::curve ? slide(p, best) : roam(p, best);
  }

  bool slide(std::uint32_t p, Worth best) {
    const SlidingCurve& curve = curves_[curve_of_[p]];
    // A chord is no longer than its arc: half of it never passes the neighbour.
    const Vec3 x = quads_.points[p];
    const double room =
        0.45 * std::min(length(quads_.points[beside_[p][0]] - x), length(quads_.points[beside_[p][1]] - x));
    double s = arc_m_[p];
    const double from = s;
    bool any = false;
    for (double step = 0.5 * room; step > 0.01 * room; step *= 0.5)
      for (const double to : {s - step, s + step}) {
        if (std::abs(to - from) > room || (!curve.is_closed && (to <= 0 || to >= curve.arc_m.back()))) continue;
        const Worth worth = worth_at(p, curve.at(to));
        if (!is_better(worth, best)) continue;
        best = worth;
        s = to;
        any = true;
      }
    if (any) {
      arc_m_[p] = s;
      quads_.points[p] = curve.at(s);
    }
    return any;
  }

  bool roam(std::uint32_t p, Worth best) {
    const Vec3 start = quads_.points[p];
    Vec3 middle;
    double span = 0;
    int count = 0;
    for (const std::uint32_t q : quads_around(p)) {
      const auto& c = quads_.quads[q];
      const auto k = static_cast<std::size_t>(std::find(c.begin(), c.end(), p) - c.begin());
      const Vec3& n = quads_.points[c[(k + 1) % 4]];
      middle = middle + n;
      span += length(n - start);
      ++count;
    }
    middle = (1.0 / count) * middle;
    span /= count;
    Vec3 u{1, 0, 0}, v{0, 1, 0};
    if (!is_plane_) {
      const Vec3 n = normals_[quads_around(p)[0]];
      u = cross(n, std::abs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
      u = (1 / length(u)) * u;
      v = cross(n, u);
    }
    Vec3 at = start;
    bool any = false;
    const auto attempt = [&](const Vec3& wanted) {
      const Vec3 to = is_plane_ ? wanted : onto_surface(wanted, quads_around(p)[0]);
      const Worth worth = worth_at(p, to);
      if (!is_better(worth, best)) return;
      best = worth;
      at = to;
      any = true;
    };
    attempt(middle);
    attempt(0.5 * (middle + start));
    for (double step = 0.25 * span; step > 0.01 * span; step *= 0.5) {
      const Vec3 centre = at;
      constexpr double d = 0.70710678118654752;
      for (const auto& [x, y] : {std::pair(1.0, 0.0), std::pair(d, d), std::pair(0.0, 1.0), std::pair(-d, d),
                                 std::pair(-1.0, 0.0), std::pair(-d, -d), std::pair(0.0, -1.0), std::pair(d, -d)})
        attempt(centre + (step * x) * u + (step * y) * v);
    }
    quads_.points[p] = at;
    return any;
  }

  Vec3 onto_surface(const Vec3& p, std::uint32_t quad) const {
    const std::uint32_t t = nearest(p, quad);
    const Vec3 &a = mesh_.points[mesh_.triangles[t][0]], &b = mesh_.points[mesh_.triangles[t][1]],
               &c = mesh_.points[mesh_.triangles[t][2]];
    const Vec3 n = normal_of(t), flat = p - dot(p - a, n) * n;
    const Vec3 corner[3] = {a, b, c};
    Vec3 best = flat;
    double nearest = std::numeric_limits<double>::infinity();
    bool is_inside = true;
    for (int k = 0; k < 3; ++k) {
      const Vec3 &from = corner[k], &to = corner[(k + 1) % 3];
      is_inside = is_inside && dot(cross(to - from, flat - from), n) >= 0;
      const Vec3 on = between(from, to, nearest_parameter(p, from, to));
      if (length(on - p) < nearest) {
        nearest = length(on - p);
        best = on;
      }
    }
    return is_inside ? flat : best;
  }

  QuadMesh& quads_;
  const FeatureMesh& mesh_;
  const QuadSmoothing& options_;
  bool is_plane_ = true;
  struct Sheet {
    NearestTriangle nearest;
    std::vector<std::uint32_t> triangles;
  };
  std::vector<Sheet> sheets_;         ///< on surfaces: patches of triangles that quads lie on
  std::vector<std::uint32_t> sheet_;  ///< per quad
  std::vector<std::uint32_t> first_, around_;
  std::vector<Kind> kind_;
  std::vector<std::array<std::uint32_t, 2>> beside_;  ///< per point on a curve: its neighbours there
  std::vector<SlidingCurve> curves_;
  std::vector<std::uint32_t> curve_of_;
  std::vector<double> arc_m_;
  std::vector<Vec3> normals_;     ///< per quad
  double barrier_ = 0;            ///< > 0 while untangling
  std::vector<double> scale_m2_;  ///< per quad, while untangling
};

}  // namespace

Result<SmoothingReport> smooth_quads(QuadMesh& quads, const FeatureMesh& mesh, const QuadSmoothing& options) {
  return QuadSmoother(quads, mesh, options).run();
}

}  // namespace strataflow
