#include "kernels/quads/plan/plan_mesh.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>

#include "kernels/adapters/cgal/constrained_delaunay.h"
#include "kernels/quads/plan/open_corners.h"
#include "kernels/quads/plan/plan_curves.h"
#include "kernels/quads/plan/plan_graph.h"
#include "kernels/quads/plan/plane_geometry.h"
#include "kernels/quads/plan/refine_plan.h"
#include "kernels/quads/plan/sample_plan.h"
#include "kernels/quads/plan/snap_tips.h"
#include "kernels/quads/plan/widen_faults.h"
#include "kernels/topology/union_find.h"

namespace strataflow {

namespace {

bool bounds_domain(Role role) { return role == Role::outline || role == Role::boundary; }

/// Per triangle: whether an odd number of outlines and an even number of holes is around it.
std::vector<char> inside_domain(const PlaneTriangulation& mesh, const SampledPlan& plan, const PlanGraph& graph) {
  const auto crossed = [&](std::uint32_t h) {
    std::uint8_t parity = 0;
    if (mesh.is_fixed(h))
      for (const std::uint32_t f : graph.segments[plan.pieces[mesh.label(h)].segment].features) {
        const Role role = graph.features[f].role;
        if (bounds_domain(role)) parity ^= 1;
        if (role == Role::hole) parity ^= 2;
      }
    return parity;
  };
  constexpr std::uint8_t unknown = 4;
  std::vector<std::uint8_t> state(mesh.triangles().size(), unknown);
  std::deque<std::uint32_t> queue;
  for (std::uint32_t h = 0; h < mesh.half_edge_count(); ++h)
    if (mesh.opposite(h) == no_index && state[h / 3] == unknown) {
      state[h / 3] = crossed(h);
      queue.push_back(h / 3);
    }
  while (!queue.empty()) {
    const std::uint32_t t = queue.front();
    queue.pop_front();
    for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
      const std::uint32_t g = mesh.opposite(h);
      if (g == no_index || state[g / 3] != unknown) continue;
      state[g / 3] = state[t] ^ crossed(h);
      queue.push_back(g / 3);
    }
  }
  std::vector<char> inside(state.size());
  for (std::size_t t = 0; t < state.size(); ++t) inside[t] = state[t] == 1;
  return inside;
}

struct Side {
  double angle;
  std::uint32_t segment;
};

/// Segments of the graph around a point, counter-clockwise.
std::vector<Side> sides_around(const PlanGraph& graph, const std::vector<std::uint32_t>& incident, std::uint32_t p) {
  std::vector<Side> sides;
  for (const std::uint32_t s : incident) {
    const auto& segment = graph.segments[s];
    const Vec3 d = graph.points[segment.a == p ? segment.b : segment.a] - graph.points[p];
    sides.push_back({std::atan2(d.y, d.x), s});
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.angle < b.angle; });
  return sides;
}

bool share_a_feature(const PlanGraph::Segment& a, const PlanGraph::Segment& b) {
  return std::any_of(a.features.begin(), a.features.end(),
                     [&](std::uint32_t f) { return std::binary_search(b.features.begin(), b.features.end(), f); });
}

/// Between two sides, degrees in (0, 180].
double angle_between(const Side& a, const Side& b) {
  const double angle = std::abs(a.angle - b.angle) * 180 / std::numbers::pi;
  return angle > 180 ? 360 - angle : angle;
}

/// Segments that run on into each other, as the lowest segment of their group.
std::vector<std::uint32_t> straight_groups(const PlanGraph& graph, double corner_deg) {
  UnionFind groups(graph.segments.size());
  const auto incident = graph.incident();
  for (std::uint32_t p = 0; p < graph.points.size(); ++p) {
    const auto sides = sides_around(graph, incident[p], p);
    for (std::size_t i = 0; i < sides.size(); ++i)
      for (std::size_t j = i + 1; j < sides.size(); ++j)
        if (angle_between(sides[i], sides[j]) >= 180 - corner_deg &&
            share_a_feature(graph.segments[sides[i].segment], graph.segments[sides[j].segment]))
          groups.unite(sides[i].segment, sides[j].segment);
  }
  std::vector<std::uint32_t> group(graph.segments.size());
  for (std::uint32_t s = 0; s < group.size(); ++s) group[s] = groups.find(s);
  return group;
}

class FeatureMeshBuilder {
 public:
  FeatureMeshBuilder(const PlaneTriangulation& mesh, const SampledPlan& plan, PlanGraph& graph,
                     const PlanOptions& options)
      : mesh_(mesh), plan_(plan), graph_(graph), options_(options) {}

  FeatureMesh run(const Vec3& local_origin) {
    number_points();
    add_edges();
    add_corners();
    result_.local_origin = local_origin;
    result_.features = graph_.features;
    result_.edge_length_m = graph_.edge_length_m;
    result_.changes = std::move(graph_.changes);
    return std::move(result_);
  }

 private:
  bool is_feature(std::uint32_t f) const { return !options_.free_boundary || !bounds_domain(graph_.features[f].role); }

  void number_points() {
    number_.assign(mesh_.points().size(), no_index);
    for (const Triangle& t : mesh_.triangles())
      for (const std::uint32_t p : t) number_[p] = 0;
    for (std::uint32_t p = 0; p < number_.size(); ++p) {
      if (number_[p] == no_index) continue;
      number_[p] = static_cast<std::uint32_t>(result_.points.size());
      result_.points.push_back(mesh_.points()[p]);
    }
    for (const Triangle& t : mesh_.triangles())
      result_.triangles.push_back({number_[t[0]], number_[t[1]], number_[t[2]]});
  }

  void add_edges() {
    is_segment_inside_.assign(graph_.segments.size(), 0);
    for (std::uint32_t h = 0; h < mesh_.half_edge_count(); ++h) {
      if (!mesh_.is_fixed(h)) continue;
      const std::uint32_t segment = plan_.pieces[mesh_.label(h)].segment;
      is_segment_inside_[segment] = 1;
      if (mesh_.opposite(h) != no_index && mesh_.opposite(h) < h) continue;
      const std::uint32_t a = number_[mesh_.origin(h)], b = number_[mesh_.target(h)];
      for (const std::uint32_t f : graph_.segments[segment].features)
        if (is_feature(f)) result_.edges.push_back({std::min(a, b), std::max(a, b), f});
    }
    std::sort(result_.edges.begin(), result_.edges.end());
    std::vector<double> outside_m(graph_.features.size(), 0);
    for (std::uint32_t s = 0; s < graph_.segments.size(); ++s)
      if (!is_segment_inside_[s])
        for (const std::uint32_t f : graph_.segments[s].features)
          outside_m[f] += length(graph_.points[graph_.segments[s].a] - graph_.points[graph_.segments[s].b]);
    for (std::size_t f = 0; f < outside_m.size(); ++f)
      if (outside_m[f] > 0)
        graph_.changes.push_back({"cut", graph_.features[f].name + ": " + short_number(outside_m[f]) + " m of it",
                                  "it lies outside the outline or in a hole"});
  }

  void add_corners() {
    const auto incident = graph_.incident();
    for (std::uint32_t p = 0; p < graph_.points.size(); ++p) {
      if (number_[p] == no_index) continue;
      std::vector<std::uint32_t> kept;
      bool touches_free_outline = false;
      for (const std::uint32_t s : incident[p]) {
        const auto& features = graph_.segments[s].features;
        const bool holds =
            std::any_of(features.begin(), features.end(), [&](std::uint32_t f) { return is_feature(f); });
        if (is_segment_inside_[s] && holds) kept.push_back(s);
        touches_free_outline = touches_free_outline || (is_segment_inside_[s] && !holds);
      }
      bool is_corner = graph_.is_required[p] != 0;
      if (kept.size() == 2) {
        const auto sides = sides_around(graph_, kept, p);
        is_corner = is_corner || graph_.segments[kept[0]].features != graph_.segments[kept[1]].features ||
                    angle_between(sides[0], sides[1]) < 180 - options_.corner_deg;
      } else if (!kept.empty()) {
        is_corner = is_corner || kept.size() > 2 || !touches_free_outline;
      }
      if (is_corner) result_.corners.push_back(number_[p]);
    }
    std::sort(result_.corners.begin(), result_.corners.end());
  }

  const PlaneTriangulation& mesh_;
  const SampledPlan& plan_;
  PlanGraph& graph_;
  const PlanOptions& options_;
  FeatureMesh result_;
  std::vector<std::uint32_t> number_;
  std::vector<char> is_segment_inside_;
};

}  // namespace

Result<FeatureMesh> plan_mesh(std::span<const Polyline> lines, std::span<const PointSet> point_sets,
                              const Vec3& local_origin, const PlanOptions& options) {
  Result<PlanCurves> curves = plan_curves(lines, point_sets, options);
  if (!curves) return curves.failure();
  const double edge_m = curves->edge_length_m, limit_m = options.move_ratio * edge_m;
  snap_tips(*curves, limit_m);
  Result<PlanGraph> arranged = arrange_curves(std::move(*curves));
  if (!arranged) return arranged.failure();
  PlanGraph graph = std::move(*arranged);
  contract_short_edges(graph, limit_m);
  open_acute_corners(graph, limit_m, options.open_below_deg);
  if (!options.fault_thickness_m.empty()) {
    Result<PlanCurves> widened = widen_faults(std::move(graph), options);
    if (!widened) return widened.failure();
    arranged = arrange_curves(std::move(*widened));
    if (!arranged) return arranged.failure();
    graph = std::move(*arranged);
    double thinnest = edge_m;
    for (const auto& [name, thickness] : options.fault_thickness_m) thinnest = std::min(thinnest, thickness);
    contract_short_edges(graph, std::min(limit_m, 0.25 * thinnest));
  }
  const double triangle_edge_m = options.triangle_ratio * edge_m;
  Result<SampledPlan> sampled = sample_plan(graph, triangle_edge_m);
  if (!sampled) return sampled.failure();
  std::vector<PlaneSegment> fixed;
  for (const SampledPlan::Piece& piece : sampled->pieces) fixed.push_back(piece.ends);
  Result<std::vector<Triangle>> triangles = constrained_delaunay(sampled->points, fixed);
  if (!triangles) return triangles.failure();
  PlaneTriangulation mesh(sampled->points, std::move(*triangles), fixed);
  const std::vector<char> inside = inside_domain(mesh, *sampled, graph);
  if (std::find(inside.begin(), inside.end(), 1) == inside.end())
    return Failure{FailureCode::invalid_input, "the outline encloses nothing", "give the outline as a closed curve"};
  mesh.keep(inside);
  const Result<void> refined = refine_plan(mesh, *sampled, triangle_edge_m);
  if (!refined) return refined.failure();
  fit_triangles_to_features(mesh, *sampled, graph, straight_groups(graph, options.corner_deg));
  return FeatureMeshBuilder(mesh, *sampled, graph, options).run(local_origin);
}

}  // namespace strataflow
