#include "kernels/quads/plan/widen_faults.h"

#include <algorithm>
#include <optional>

#include "base/id.h"
#include "kernels/quads/plan/plane_geometry.h"

namespace strataflow {

namespace {

/// A polyline of one feature through the nodes of a graph.
struct Chain {
  std::vector<std::uint32_t> nodes;
  bool is_closed = false;
};

std::vector<Chain> chains_of(const PlanGraph& graph, std::uint32_t feature) {
  std::vector<std::vector<std::uint32_t>> around(graph.points.size());
  std::vector<std::uint32_t> mine;
  for (std::uint32_t s = 0; s < graph.segments.size(); ++s) {
    const auto& segment = graph.segments[s];
    if (!std::binary_search(segment.features.begin(), segment.features.end(), feature)) continue;
    mine.push_back(s);
    around[segment.a].push_back(s);
    around[segment.b].push_back(s);
  }
  std::vector<char> is_used(graph.segments.size(), 0);
  std::vector<Chain> chains;
  const auto walk = [&](std::uint32_t from, std::uint32_t s) {
    Chain chain{{from}, false};
    for (;;) {
      is_used[s] = 1;
      const std::uint32_t p = graph.segments[s].a == chain.nodes.back() ? graph.segments[s].b : graph.segments[s].a;
      chain.is_closed = p == from;
      if (chain.is_closed) break;
      chain.nodes.push_back(p);
      if (around[p].size() != 2) break;
      s = around[p][0] == s ? around[p][1] : around[p][0];
    }
    chains.push_back(std::move(chain));
  };
  for (const std::uint32_t s : mine)
    for (const std::uint32_t p : {graph.segments[s].a, graph.segments[s].b})
      if (!is_used[s] && around[p].size() != 2) walk(p, s);
  for (const std::uint32_t s : mine)
    if (!is_used[s]) walk(graph.segments[s].a, s);
  return chains;
}

Vec3 left_of(const Vec3& from, const Vec3& to) {
  const Vec3 d = to - from;
  return (1 / length(d)) * Vec3{-d.y, d.x, 0};
}

/// The polyline moved to its left by `by`, with mitred bends.
std::vector<Vec3> moved_aside(const std::vector<Vec3>& points, bool is_closed, double by) {
  std::vector<Vec3> aside;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const bool has_before = is_closed || i > 0, has_after = is_closed || i + 1 < n;
    const Vec3 before = has_before ? left_of(points[(i + n - 1) % n], points[i]) : left_of(points[i], points[i + 1]);
    const Vec3 after = has_after ? left_of(points[i], points[(i + 1) % n]) : before;
    const Vec3 sum = before + after;
    constexpr double longest_mitre = 2;
    const double squared = dot(sum, sum);
    const double stretch = squared > 0 ? std::min(2 / squared, longest_mitre / std::sqrt(squared)) : 0;
    aside.push_back(points[i] + (by * stretch) * sum);
  }
  return aside;
}

class FaultWidening {
 public:
  FaultWidening(PlanGraph graph, const PlanOptions& options) : graph_(std::move(graph)), options_(options) {}

  Result<PlanCurves> run() {
    plan_.features = graph_.features;
    plan_.edge_length_m = graph_.edge_length_m;
    thickness_m_.assign(graph_.features.size(), 0);
    for (const auto& [name, thickness] : options_.fault_thickness_m) {
      bool is_known = false;
      for (std::size_t f = 0; f < graph_.features.size(); ++f)
        if (graph_.features[f].name == name && graph_.features[f].role == Role::fault) {
          thickness_m_[f] = thickness;
          is_known = true;
        }
      if (!is_known || !(thickness >= 0.05 * graph_.edge_length_m) || !(thickness < 100 * graph_.edge_length_m))
        return Failure{FailureCode::invalid_options,
                       is_known ? "the thickness of \"" + name + "\", " + short_number(thickness) +
                                      " m, does not suit edges of " + short_number(graph_.edge_length_m) + " m"
                                : "fault_thickness_m names \"" + name + "\", which is no fault here",
                       "name a fault, and give at least a twentieth of an edge length"};
    }
    for (std::uint32_t f = 0; f < graph_.features.size(); ++f) {
      for (const Chain& chain : chains_of(graph_, f)) {
        std::vector<Vec3> points;
        for (const std::uint32_t p : chain.nodes) points.push_back(graph_.points[p]);
        if (thickness_m_[f] > 0)
          add_strip(f, chain, points);
        else
          plan_.curves.push_back({f, std::move(points), chain.is_closed, 0});
      }
    }
    end_on_sides();
    for (std::uint32_t p = 0; p < graph_.points.size(); ++p)
      if (graph_.is_required[p]) plan_.points.push_back(graph_.points[p]);
    double thinnest = graph_.edge_length_m;
    for (const double t : thickness_m_)
      if (t > 0) thinnest = std::min(thinnest, t);
    for (PlanCurve& curve : plan_.curves) curve.short_below_m = 0.25 * thinnest;
    plan_.changes = std::move(graph_.changes);
    return std::move(plan_);
  }

 private:
  struct Strip {
    std::uint32_t feature = 0;  ///< of the trace
    std::vector<Vec3> trace;
    std::size_t left = 0, right = 0;  ///< curves
    bool is_closed = false;
    std::array<bool, 2> is_attached{};
  };

  /// The features of a strip: left takes the trace's number.
  std::array<std::uint32_t, 2> features_of(std::uint32_t f) {
    if (right_of_.empty()) right_of_.assign(graph_.features.size(), no_index);
    if (right_of_[f] == no_index) {
      const std::string name = graph_.features[f].name;
      right_of_[f] = static_cast<std::uint32_t>(plan_.features.size());
      plan_.features.push_back({name + " right", Role::fault, 0, -1});
      plan_.features.push_back({name + " end", Role::fault, 0, -1});
      plan_.features[f] = {name + " left", Role::fault, static_cast<std::uint32_t>(options_.strip_quads),
                           static_cast<std::int32_t>(right_of_[f])};
      graph_.changes.push_back({"widened", name, "it is " + short_number(thickness_m_[f]) + " m thick"});
    }
    return {f, right_of_[f]};
  }

  void add_strip(std::uint32_t f, const Chain& chain, const std::vector<Vec3>& points) {
    const auto [left, right] = features_of(f);
    const double half = 0.5 * thickness_m_[f];
    Strip strip{f, points, plan_.curves.size(), plan_.curves.size() + 1, chain.is_closed, {}};
    plan_.curves.push_back({left, moved_aside(points, chain.is_closed, half), chain.is_closed, 0});
    plan_.curves.push_back({right, moved_aside(points, chain.is_closed, -half), chain.is_closed, 0});
    if (!chain.is_closed)
      for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) {
        const std::uint32_t node = end == 0 ? chain.nodes.front() : chain.nodes.back();
        const auto incident = graph_.incident()[node];
        strip.is_attached[end] = incident.size() > 1;
        if (strip.is_attached[end]) continue;
        const Vec3 a = end == 0 ? plan_.curves[strip.left].points.front() : plan_.curves[strip.left].points.back();
        const Vec3 b = end == 0 ? plan_.curves[strip.right].points.front() : plan_.curves[strip.right].points.back();
        plan_.curves.push_back({right_of_[f] + 1, {a, b}, false, 0});
      }
    strips_.push_back(std::move(strip));
  }

  /// Sides of strips that end on a curve reach it; curves that end on a strip's trace end on its side.
  void end_on_sides() {
    std::vector<char> is_side(plan_.curves.size(), 0);
    for (const Strip& strip : strips_) {
      is_side[strip.left] = is_side[strip.right] = 1;
      for (const bool at_front : {true, false}) {
        if (strip.is_closed || !strip.is_attached[at_front ? 0 : 1]) continue;
        for (const std::size_t side : {strip.left, strip.right})
          end_on(side, at_front, 3 * thickness_m_[strip.feature], [&](std::size_t c) {
            return c != strip.left && c != strip.right && plan_.curves[c].feature != right_of_[strip.feature] + 1;
          });
      }
    }
    for (std::size_t c = 0; c < is_side.size(); ++c) {
      if (is_side[c] || plan_.curves[c].is_closed) continue;
      for (const bool at_front : {true, false}) {
        const Vec3 tip = at_front ? plan_.curves[c].points.front() : plan_.curves[c].points.back();
        for (const Strip& strip : strips_)
          if (std::find(strip.trace.begin(), strip.trace.end(), tip) != strip.trace.end())
            end_on(c, at_front, 3 * thickness_m_[strip.feature],
                   [&](std::size_t other) { return other == strip.left || other == strip.right; });
      }
    }
  }

  /// Cuts or prolongs one end of a curve at the first curve that its last `reach_m` and as much again cross.
  template <class Accept>
  void end_on(std::size_t c, bool at_front, double reach_m, Accept&& accept) {
    PlanCurve& curve = plan_.curves[c];
    if (at_front) std::reverse(curve.points.begin(), curve.points.end());
    const Vec3 tip = curve.points.back();
    Vec3 ahead = tip - curve.points[curve.points.size() - 2];
    ahead = tip + (reach_m / length(ahead)) * ahead;
    // Segments of the tail, from inside to beyond the tip.
    std::size_t first = curve.points.size() - 1;
    while (first > 0 && length(curve.points[first] - tip) < reach_m) --first;
    for (std::size_t i = first; i < curve.points.size(); ++i) {
      const Vec3 p = curve.points[i], q = i + 1 < curve.points.size() ? curve.points[i + 1] : ahead;
      double nearest = 2;
      std::size_t other = 0, segment = 0;
      Vec3 at;
      for (std::size_t k = 0; k < plan_.curves.size(); ++k) {
        if (k == c || !accept(k)) continue;
        const PlanCurve& target = plan_.curves[k];
        const std::size_t n = target.points.size();
        for (std::size_t s = 0; s + (target.is_closed ? 0 : 1) < n; ++s) {
          const Vec3 a = target.points[s], b = target.points[(s + 1) % n];
          const int side_a = turn(p, q, a), side_b = turn(p, q, b), from = turn(a, b, p);
          if (side_a * side_b > 0 || (side_a == 0 && side_b == 0) || from == 0 || from * turn(a, b, q) > 0) continue;
          const double t = std::clamp(cross(a - p, b - a).z / cross(q - p, b - a).z, 0.0, 1.0);
          if (t < nearest) {
            nearest = t;
            other = k;
            segment = s;
            at = side_a == 0 ? a : side_b == 0 ? b : between(p, q, t);
          }
        }
      }
      if (nearest > 1) continue;
      curve.points.resize(i + 1);
      if (at != p) curve.points.push_back(at);
      PlanCurve& target = plan_.curves[other];
      if (at != target.points[segment] && at != target.points[(segment + 1) % target.points.size()])
        target.points.insert(target.points.begin() + static_cast<std::ptrdiff_t>(segment + 1), at);
      break;
    }
    if (at_front) std::reverse(curve.points.begin(), curve.points.end());
  }

  PlanGraph graph_;
  const PlanOptions& options_;
  PlanCurves plan_;
  std::vector<double> thickness_m_;      ///< per feature of the graph; 0: a line
  std::vector<std::uint32_t> right_of_;  ///< per feature of the graph
  std::vector<Strip> strips_;
};

}  // namespace

Result<PlanCurves> widen_faults(PlanGraph graph, const PlanOptions& options) {
  return FaultWidening(std::move(graph), options).run();
}

}  // namespace strataflow
