#pragma once
#include <vector>

#include "kernels/hexes/wall_sheets.h"

namespace strataflow {

/// Per tetrahedron (x, y, −1): the smoothest field of descending directions that is tangent to every fault and side
/// (coudert2024 S17, 2.3), found in the whole volume. Walls that touch an upright line where sheets meet have its
/// direction, so that nothing that goes down them falls into it. Tetrahedra should have gone through separate_walls; of
/// several walls of one the first counts. Walls within 5° of horizontal do not count.
std::vector<Vec3> gravity_field(const LabelledTets& tets, const WallSheets& sheets);

}  // namespace strataflow
