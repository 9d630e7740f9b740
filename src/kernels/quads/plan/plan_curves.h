#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "kernels/quads/plan/plan_options.h"
#include "model/feature_mesh.h"
#include "model/input_data.h"

namespace strataflow {

/// A curve of the plan: a feature, or one of its pieces. z is 0.
struct PlanCurve {
  std::uint32_t feature = 0;
  std::vector<Vec3> points;  ///< a closed curve does not repeat its first
  bool is_closed = false;
  double short_below_m = 0;  ///< edges below this length may be contracted
};

/// What the plan is made of: curves with the features they belong to, and points that must become vertices.
struct PlanCurves {
  std::vector<Feature> features;
  std::vector<PlanCurve> curves;
  std::vector<Vec3> points;
  std::vector<std::array<Vec3, 2>> moved;  ///< from, to: what snapping did, to be held against the limit
  std::vector<Change> changes;
  double edge_length_m = 0;
};

/// Curves from lines with roles, seen from above: outlines and holes are closed, a well that goes straight down becomes
/// a circle (coudert2024 S21), repeated points are dropped, and without an outline a box is put around everything.
/// Lines of one name and role are one feature. Fails with invalid_input on coordinates that are not finite and when
/// there is nothing to mesh, invalid_options when the edge length does not suit the domain.
Result<PlanCurves> plan_curves(std::span<const Polyline> lines, std::span<const PointSet> point_sets,
                               const PlanOptions& options);

/// The trace of a fault given as sticks: their first points, in order (Drogon's files).
Polyline trace_of_sticks(std::span<const Polyline> sticks);

}  // namespace strataflow
