#include "kernels/hexes/extrusion/plan_edges.h"

#include <algorithm>
#include <limits>

#include "kernels/topology/sorted_unique.h"

namespace strataflow {
namespace {

std::uint32_t entity_named(const LabelledTets& model, const std::string& name) {
  for (std::uint32_t e = 0; e < model.entities.size(); ++e)
    if (model.entities[e].name == name) return e;
  return no_index;
}

Result<void> find_edges(const QuadMesh& plan, PlanEdges& found) {
  struct Side {
    std::uint32_t a, b, quad, side;
  };
  std::vector<Side> sides;
  for (std::uint32_t q = 0; q < plan.quads.size(); ++q)
    for (std::uint32_t k = 0; k < 4; ++k) {
      const std::uint32_t a = plan.quads[q][k], b = plan.quads[q][(k + 1) % 4];
      if (a >= plan.points.size() || b >= plan.points.size() || a == b) return bad_plan("a quad is not one");
      sides.push_back({std::min(a, b), std::max(a, b), q, k});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& x, const Side& y) {
    return std::array{x.a, x.b, x.quad, x.side} < std::array{y.a, y.b, y.quad, y.side};
  });
  found.edge_of.assign(4 * plan.quads.size(), 0);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const bool is_second = i > 0 && sides[i].a == sides[i - 1].a && sides[i].b == sides[i - 1].b;
    if (!is_second) found.edges.push_back({});
    PlanEdge& edge = found.edges.back();
    if (is_second && edge.quads[1] != no_index) return bad_plan("three quads share an edge");
    edge.points = {sides[i].a, sides[i].b};
    edge.quads[is_second ? 1 : 0] = sides[i].quad;
    edge.sides[is_second ? 1 : 0] = sides[i].side;
    found.edge_of[4 * sides[i].quad + sides[i].side] = static_cast<std::uint32_t>(found.edges.size() - 1);
  }
  return {};
}

Result<void> find_traces(const QuadMesh& plan, const LabelledTets& model, PlanEdges& found) {
  found.is_on_fault.assign(plan.points.size(), 0);
  found.is_on_outline.assign(plan.points.size(), 0);
  found.faults_at.resize(plan.points.size());
  for (const PlanEdge& edge : found.edges)
    for (const std::uint32_t p : edge.points)
      if (edge.quads[1] == no_index) found.is_on_outline[p] = 1;
  for (const FeatureEdge& on : plan.edges) {
    const Feature& feature = plan.features[on.feature];
    const std::array<std::uint32_t, 2> ends{on.a, on.b};
    const auto edge = std::lower_bound(found.edges.begin(), found.edges.end(), ends,
                                       [](const PlanEdge& e, const auto& key) { return e.points < key; });
    if (edge == found.edges.end() || edge->points != ends)
      return bad_plan(feature.name + " leaves the edges of the quads");
    const std::uint32_t entity = entity_named(model, feature.name);
    if (edge->quads[1] == no_index && entity != no_index) edge->side_entity = static_cast<std::int32_t>(entity);
    if (feature.role != Role::fault || edge->quads[1] == no_index || found.zones.is_strip_feature[on.feature]) continue;
    if (entity == no_index) return bad_plan("the plan follows " + feature.name + ", which the model has not");
    edge->faults.push_back(entity);
    for (const std::uint32_t p : ends) {
      found.is_on_fault[p] = 1;
      found.faults_at[p].push_back(entity);
    }
  }
  for (std::vector<std::uint32_t>& faults : found.faults_at) faults = sorted_unique(std::move(faults));
  return {};
}

void find_wedges(const QuadMesh& plan, PlanEdges& found) {
  found.first_wedge.assign(plan.points.size() + 1, 0);
  for (const auto& quad : plan.quads)
    for (const std::uint32_t p : quad) ++found.first_wedge[p + 1];
  for (std::size_t p = 0; p < plan.points.size(); ++p) found.first_wedge[p + 1] += found.first_wedge[p];
  found.wedges.resize(4 * plan.quads.size());
  std::vector<std::uint32_t> next = found.first_wedge;
  for (std::uint32_t q = 0; q < plan.quads.size(); ++q)
    for (std::uint32_t k = 0; k < 4; ++k) found.wedges[next[plan.quads[q][k]]++] = 4 * q + k;
  found.local_edge_m.assign(plan.points.size(), std::numeric_limits<double>::infinity());
  for (const PlanEdge& edge : found.edges)
    for (const std::uint32_t p : edge.points)
      found.local_edge_m[p] =
          std::min(found.local_edge_m[p], length(plan.points[edge.points[0]] - plan.points[edge.points[1]]));
}

}  // namespace

Failure bad_plan(std::string what) {
  return {FailureCode::invalid_input, std::move(what), "make the plan from the curves of this model"};
}

Result<PlanEdges> find_plan_edges(const QuadMesh& plan, const LabelledTets& model) {
  PlanEdges found;
  if (const Result<void> done = find_edges(plan, found); !done) return done.failure();
  for (const FeatureEdge& on : plan.edges)
    if (on.feature >= plan.features.size() || on.a >= plan.points.size() || on.b >= plan.points.size())
      return bad_plan("an edge lies on a feature or ends at a point that is not there");
  found.zones = find_plan_zones(plan);
  if (const Result<void> done = find_traces(plan, model, found); !done) return done.failure();
  find_wedges(plan, found);
  return found;
}

}  // namespace strataflow
