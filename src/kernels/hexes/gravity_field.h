#pragma once
#include <vector>

#include "kernels/hexes/labelled_tets.h"

namespace strataflow {

/// Per tetrahedron (x, y, −1): the smoothest field of descending directions that is tangent to every fault and side
/// (coudert2024 S17, 2.3), found in the whole volume. Tetrahedra should have gone through separate_walls; of several
/// walls of one the first counts. Walls within 5° of horizontal do not count.
std::vector<Vec3> gravity_field(const LabelledTets& tets);

}  // namespace strataflow
