#pragma once
#include <vector>

#include "base/result.h"
#include "kernels/quads/plan/plane_triangulation.h"
#include "kernels/quads/plan/sample_plan.h"

namespace strataflow {

/// Refines a constrained Delaunay triangulation whose fixed edges are labelled with the pieces of `plan`: circumcentres
/// of triangles that are too large or too flat are inserted (after Ruppert and Chew), pieces are halved where
/// a circumcentre comes too near. No two points get closer than about half the size wanted there, so the number of
/// points is bounded and corners of any angle are left in peace. Then free points are evened out. `plan.size_m` grows
/// with the points. Fails with invalid_options past `point_limit` points.
Result<void> refine_plan(PlaneTriangulation& mesh, SampledPlan& plan, double triangle_edge_m,
                         std::size_t point_limit = 5'000'000);

/// Splits triangles that a map with straight features would flatten: two sides on one curve, or a chord between points
/// of one curve. `group_of_segment`: segments of the graph that run on into each other have one group. Then makes one
/// triangle fill each acute corner where that is possible (coudert2024 S28).
void fit_triangles_to_features(PlaneTriangulation& mesh, SampledPlan& plan, const PlanGraph& graph,
                               const std::vector<std::uint32_t>& group_of_segment);

}  // namespace strataflow
