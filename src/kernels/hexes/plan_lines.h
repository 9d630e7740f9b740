#pragma once
#include <optional>
#include <vector>

#include "kernels/hexes/verticalise.h"
#include "model/input_data.h"

namespace strataflow {

/// The curves that a plan of quads must follow, in (U, V), z = 0 (coudert2024 S10, S19): the lower edges of every fault
/// that is aligned, named as it; those of the sides as closed outlines, the others of them as holes; and if asked for the
/// lines where horizons meet, as curves "H3-E". Coordinates are relative to the model's local origin. Faults come by
/// entity, pieces by their first point.
std::vector<Polyline> plan_lines(const LabelledTets& tets, const UprightPlan& upright, bool with_horizon_lines = false);

/// Where the point of the top seen at (x, y) from above lies in the plan; nothing beside the model. `plan` holds (u, v)
/// per point of the model.
std::optional<Vec3> plan_position(const LabelledTets& tets, const std::vector<Vec3>& plan, double x, double y);

/// Chains edges into polylines that end where other than two meet; closed ones do not repeat their first point.
struct PointChain {
  std::vector<std::uint32_t> points;
  bool is_closed = false;
};
std::vector<PointChain> chain_edges(std::vector<std::array<std::uint32_t, 2>> edges);

}  // namespace strataflow
