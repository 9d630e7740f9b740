#pragma once
#include "model/corner_point_grid.h"
#include "model/input_data.h"

namespace strataflow {

/// The active cells of a corner-point grid as hexahedra; corners with the same coordinates become one point, so cells
/// are joined wherever they fit, and the two sides of an offset fault are not. Cells without height at all four pillars
/// and those with a corner at infinity are left out, which warnings count. A mirrored grid (left-handed indices) is
/// turned over. `layer_region`: a region per K; may be empty, then all is region 0.
InputData hexahedra_of(const CornerPointGrid& grid, const std::vector<std::int32_t>& layer_region = {});

}  // namespace strataflow
