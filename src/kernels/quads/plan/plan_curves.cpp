#include "kernels/quads/plan/plan_curves.h"

#include <algorithm>
#include <numbers>
#include <string>

#include "model/box3.h"

namespace strataflow {

namespace {

Vec3 flat(const Vec3& p) { return {p.x, p.y, 0}; }

class CurveCollector {
 public:
  explicit CurveCollector(const PlanOptions& options) : options_(options) {}

  void add(const Polyline& line) {
    std::vector<Vec3> points;
    for (const Vec3& p : line.points)
      if (points.empty() || flat(p) != points.back()) points.push_back(flat(p));
    const bool must_close = line.role == Role::outline || line.role == Role::hole || line.role == Role::boundary;
    bool is_closed = line.is_closed;
    if (points.size() > 1 && points.front() == points.back()) {
      points.pop_back();
      is_closed = true;
    }
    const std::string name = name_of(line);
    if (must_close && !is_closed) {
      is_closed = true;
      told("closed", name, "an outline or a hole goes around");
    }
    if (is_closed && points.size() < 3) is_closed = false;
    if (points.size() < 2 || (must_close && !is_closed)) {
      told("dropped", name, "seen from above it has no length");
      return;
    }
    curves_.curves.push_back({feature(name, line.role), std::move(points), is_closed, curves_.edge_length_m});
  }

  void add_well(const std::string& name, const Vec3& centre) {
    const double radius = options_.well_radius_m.value_or(curves_.edge_length_m);
    const auto count = static_cast<int>(options_.well_segments);
    PlanCurve circle{feature(name, Role::well), {}, true, 0.4 * 2 * std::numbers::pi * radius / count};
    for (int i = 0; i < count; ++i) {
      const double angle = 2 * std::numbers::pi * i / count;
      circle.points.push_back(flat(centre) + radius * Vec3{std::cos(angle), std::sin(angle), 0});
    }
    curves_.curves.push_back(std::move(circle));
  }

  void told(std::string kind, std::string what, std::string why) {
    curves_.changes.push_back({std::move(kind), std::move(what), std::move(why)});
  }

  /// A well that stays within its circle is a circle, one that deviates is a curve.
  bool goes_straight_down(const Polyline& line) const {
    const double radius = options_.well_radius_m.value_or(curves_.edge_length_m);
    return std::all_of(line.points.begin(), line.points.end(),
                       [&](const Vec3& p) { return length(flat(p - line.points[0])) <= radius; });
  }

  std::string name_of(const Polyline& line) {
    ++named_;
    return line.name.empty() ? "curve " + std::to_string(named_) : line.name;
  }

  std::uint32_t feature(const std::string& name, Role role) {
    for (std::uint32_t f = 0; f < curves_.features.size(); ++f)
      if (curves_.features[f].name == name && curves_.features[f].role == role) return f;
    curves_.features.push_back({name, role, 0, -1});
    return static_cast<std::uint32_t>(curves_.features.size() - 1);
  }

  PlanCurves curves_;

 private:
  const PlanOptions& options_;
  int named_ = 0;
};

bool is_domain(Role role) { return role == Role::outline || role == Role::boundary; }

}  // namespace

Result<PlanCurves> plan_curves(std::span<const Polyline> lines, std::span<const PointSet> point_sets,
                               const PlanOptions& options) {
  if (!(options.edge_length_m >= 0) || !std::isfinite(options.edge_length_m))
    return Failure{FailureCode::invalid_options, "edge_length_m is not a length", "give metres, or leave it out"};
  Box3 box;
  bool has_outline = false;
  for (const Polyline& line : lines) {
    for (const Vec3& p : line.points) {
      if (!is_finite(p))
        return Failure{FailureCode::invalid_input, "line \"" + line.name + "\" has a coordinate that is not finite",
                       "repair the file"};
      box.take(flat(p));
    }
    has_outline = has_outline || (is_domain(line.role) && line.points.size() > 2);
  }
  for (const PointSet& set : point_sets)
    for (const Vec3& p : set.points) {
      if (!is_finite(p))
        return Failure{FailureCode::invalid_input, "points \"" + set.name + "\" have a coordinate that is not finite",
                       "repair the file"};
      box.take(flat(p));
    }
  if (box.is_empty() || !(box.diagonal_m() > 0))
    return Failure{FailureCode::invalid_input, "there is no curve to mesh", "give an outline, faults or wells"};
  CurveCollector collector(options);
  const double diagonal = box.diagonal_m();
  const double edge = options.edge_length_m > 0 ? options.edge_length_m : diagonal / 100;
  collector.curves_.edge_length_m = edge;
  if (!(diagonal / edge < 20000) || !(diagonal > edge))
    return Failure{
        FailureCode::invalid_options,
        "an edge length of " + std::to_string(edge) + " m does not suit a domain of " + std::to_string(diagonal) + " m",
        "choose an edge length between a 20 000th and the whole of the diagonal"};
  for (const Polyline& line : lines) {
    if (line.points.empty()) continue;
    if (line.role == Role::well && !line.is_closed && collector.goes_straight_down(line))
      collector.add_well(collector.name_of(line), line.points.front());
    else
      collector.add(line);
  }
  for (const PointSet& set : point_sets)
    for (std::size_t i = 0; i < set.points.size(); ++i) {
      if (set.role == Role::well)
        collector.add_well(set.points.size() == 1 ? set.name : set.name + " " + std::to_string(i + 1), set.points[i]);
      else
        collector.curves_.points.push_back(flat(set.points[i]));
    }
  if (!has_outline) {
    const double m = options.box_margin_ratio * edge;
    collector.curves_.curves.push_back({collector.feature("box", Role::outline),
                                        {{box.low.x - m, box.low.y - m, 0},
                                         {box.high.x + m, box.low.y - m, 0},
                                         {box.high.x + m, box.high.y + m, 0},
                                         {box.low.x - m, box.high.y + m, 0}},
                                        true,
                                        edge});
    collector.told("added", "box", "no line has the role outline");
  }
  return std::move(collector.curves_);
}

Polyline trace_of_sticks(std::span<const Polyline> sticks) {
  Polyline trace;
  for (const Polyline& stick : sticks) {
    if (trace.name.empty()) trace.name = stick.name;
    trace.role = stick.role;
    if (!stick.points.empty()) trace.points.push_back(stick.points.front());
  }
  return trace;
}

}  // namespace strataflow
