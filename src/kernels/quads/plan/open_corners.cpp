#include "kernels/quads/plan/open_corners.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/quads/plan/plane_geometry.h"

namespace strataflow {

namespace {

constexpr double radian = std::numbers::pi / 180;

class CornerOpening {
 public:
  CornerOpening(PlanGraph& graph, double limit_m, double wanted_deg)
      : graph_(graph),
        limit_m_(limit_m),
        wanted_(wanted_deg * radian),
        around_(graph.incident()),
        is_bent_(graph.segments.size(), 0) {}

  void run() {
    const auto count = static_cast<std::uint32_t>(graph_.points.size());
    for (std::uint32_t n = 0; n < count; ++n) open_around(n);
  }

 private:
  struct Side {
    double angle;
    std::uint32_t segment;
  };

  std::uint32_t other_end(std::uint32_t s, std::uint32_t p) const {
    return graph_.segments[s].a == p ? graph_.segments[s].b : graph_.segments[s].a;
  }
  double length_m(std::uint32_t s) const {
    return length(graph_.points[graph_.segments[s].a] - graph_.points[graph_.segments[s].b]);
  }
  bool is_outline(std::uint32_t s) const {
    const auto& features = graph_.segments[s].features;
    return std::any_of(features.begin(), features.end(), [&](std::uint32_t f) {
      const Role role = graph_.features[f].role;
      return role == Role::outline || role == Role::boundary || role == Role::hole;
    });
  }

  std::vector<Side> sides_of(std::uint32_t n) const {
    std::vector<Side> sides;
    for (const std::uint32_t s : around_[n]) {
      const Vec3 d = graph_.points[other_end(s, n)] - graph_.points[n];
      sides.push_back({std::atan2(d.y, d.x), s});
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.angle < b.angle; });
    return sides;
  }

  void open_around(std::uint32_t n) {
    const std::size_t degree = around_[n].size();
    if (degree < 2) return;
    for (std::size_t i = 0; i < degree; ++i) {
      const auto sides = sides_of(n);  // again: opening one corner moves a side of the next
      const auto gap = [&](std::size_t k) {
        const double angle = sides[(k + 1) % degree].angle - sides[k % degree].angle;
        return angle < 0 ? angle + 2 * std::numbers::pi : angle;
      };
      const double angle = gap(i);
      if (angle >= wanted_ || angle <= 0) continue;
      // Sides that have room behind them, faults before outlines.
      struct Bend {
        std::uint32_t segment;
        double turn;  // +1: counter-clockwise
      };
      std::vector<Bend> bends;
      constexpr double room = 2.5;
      if (gap(i + degree - 1) > room * wanted_) bends.push_back({sides[i].segment, -1});
      if (gap(i + 1) > room * wanted_) bends.push_back({sides[(i + 1) % degree].segment, 1});
      std::stable_sort(bends.begin(), bends.end(),
                       [&](const Bend& a, const Bend& b) { return is_outline(a.segment) < is_outline(b.segment); });
      double reach = graph_.edge_length_m;
      for (const Side& side : {sides[i], sides[(i + 1) % degree]})
        reach = std::min(reach, 0.6 * length_m(side.segment));
      double needed = reach * (std::tan(wanted_) - std::tan(angle)), bent = 0;
      for (const Bend& bend : bends) {
        const double by = bend_side(n, bend.segment, bend.turn, reach, std::min(needed, limit_m_));
        needed -= by;
        bent += by;
        if (needed <= 0.01 * limit_m_) break;
      }
      if (bent > 0)
        graph_.changes.push_back({"opened",
                                  "the corner of " + short_number(angle / radian) + "° at " +
                                      place_text(graph_.points[n]) + " between " + names(sides[i].segment) + " and " +
                                      names(sides[(i + 1) % degree].segment),
                                  "its sides bend away from each other by " + short_number(bent) + " m"});
    }
  }

  std::string names(std::uint32_t s) const {
    std::string all;
    for (const std::uint32_t f : graph_.segments[s].features)
      all += (all.empty() ? "" : ", ") + graph_.features[f].name;
    return all;
  }

  /// Puts a point on a side, `reach` from the corner and up to `by` beside it. Returns how far beside.
  double bend_side(std::uint32_t n, std::uint32_t s, double turn_to, double reach, double by) {
    if (is_bent_[s]) return 0;
    const std::uint32_t w = other_end(s, n);
    const Vec3 from = graph_.points[n], d = (1 / length_m(s)) * (graph_.points[w] - from);
    for (const double part : {1.0, 0.75, 0.5, 0.25}) {
      const double away = part * by;
      const Vec3 v = from + reach * d + (turn_to * away) * Vec3{-d.y, d.x, 0};
      const auto& trace = graph_.segments[s].trace;
      const bool is_near = std::all_of(trace.begin(), trace.end(), [&](const Vec3& x) {
        return std::min(distance_to_segment(x, from, v), distance_to_segment(x, v, graph_.points[w])) <= limit_m_;
      });
      // And back: the new point is near the input, which runs from one end over its points to the other.
      const bool is_kept = trace.empty() ? away <= limit_m_ : distance_to_trace(v, n, s, w) <= limit_m_;
      if (!is_near || !is_kept || !is_free(from, v, graph_.points[w], n, w)) continue;
      split(n, s, w, v);
      return away;
    }
    return 0;
  }

  double distance_to_trace(const Vec3& v, std::uint32_t n, std::uint32_t s, std::uint32_t w) const {
    // Points of the trace are not in order: by their place along the segment they nearly are.
    std::vector<Vec3> path = graph_.segments[s].trace;
    path.push_back(graph_.points[n]);
    path.push_back(graph_.points[w]);
    const Vec3 along = graph_.points[w] - graph_.points[n];
    std::sort(path.begin(), path.end(), [&](const Vec3& a, const Vec3& b) {
      const double x = dot(a, along), y = dot(b, along);
      return x != y ? x < y : lexicographically_less(a, b);
    });
    double least = 1e300;
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      least = std::min(least, distance_to_segment(v, path[i], path[i + 1]));
    return least;
  }

  bool is_free(const Vec3& a, const Vec3& b, const Vec3& c, std::uint32_t n, std::uint32_t w) const {
    for (std::uint32_t p = 0; p < graph_.points.size(); ++p)
      if (p != n && p != w && (graph_.is_required[p] || !around_[p].empty()) &&
          closed_triangle_holds(a, b, c, graph_.points[p]))
        return false;
    return true;
  }

  void split(std::uint32_t n, std::uint32_t s, std::uint32_t w, const Vec3& at) {
    const auto v = static_cast<std::uint32_t>(graph_.points.size());
    const auto far = static_cast<std::uint32_t>(graph_.segments.size());
    graph_.points.push_back(at);
    graph_.is_required.push_back(0);
    graph_.stands_for.push_back({});
    PlanGraph::Segment rest = graph_.segments[s];
    rest.a = std::min(v, w);
    rest.b = std::max(v, w);
    graph_.segments[s].a = n;
    graph_.segments[s].b = v;
    graph_.segments.push_back(std::move(rest));
    is_bent_[s] = 1;
    is_bent_.push_back(1);
    around_.push_back({s, far});
    std::replace(around_[w].begin(), around_[w].end(), s, far);
    std::sort(around_[w].begin(), around_[w].end());
  }

  PlanGraph& graph_;
  double limit_m_, wanted_;
  std::vector<std::vector<std::uint32_t>> around_;
  std::vector<char> is_bent_;  ///< per segment: once is enough
};

}  // namespace

void open_acute_corners(PlanGraph& graph, double limit_m, double wanted_deg) {
  if (limit_m > 0 && wanted_deg > 0) CornerOpening(graph, limit_m, wanted_deg).run();
}

}  // namespace strataflow
