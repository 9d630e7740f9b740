#pragma once
#include <span>

#include "base/result.h"
#include "kernels/quads/plan/plan_options.h"
#include "model/feature_mesh.h"
#include "model/input_data.h"

namespace strataflow {

/// The 2D problem of quad meshing (coudert2024 S10): curves are cleaned (tips first), cut at everything they share,
/// short edges contracted, nothing moved further than `move_ratio` edge lengths; then the domain between outline and
/// holes is triangulated with all curves as edges. Every change is listed in the result. All curves that are not part
/// of a free outline are features. Coordinates are relative to `local_origin`, as those of the lines.
/// Fails with invalid_input, invalid_options or geometry_failed; names the line or the option.
Result<FeatureMesh> plan_mesh(std::span<const Polyline> lines, std::span<const PointSet> point_sets,
                              const Vec3& local_origin, const PlanOptions& options);

}  // namespace strataflow
