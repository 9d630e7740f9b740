#pragma once
#include "kernels/hexes/extrude_hexes.h"

namespace strataflow {

/// The stair-step grid (coudert2024 S7): rectangular columns along the model's sides, upright pillars, one cell per
/// column and layer. Every column takes its levels from the fault block below its middle: exact where all four corners
/// lie in that block, continued by a plane where a fault cuts a corner off. So horizons are exact away from faults,
/// faults become zigzags of cell faces (lying ones where a fault leans), and cells have the region of their middles.
/// Columns whose middle is beside the model are left out. Uses only the model and W of `space`, which therefore need
/// not stand upright in the plan. Plan features are the faults; facets as those of extrude_hexes.
///
/// `edge_m` > 0 is the wanted length of the cells' sides; fails with invalid_options otherwise, geometry_failed (more
/// than 2³⁰ vertices, no column inside the model).
Result<ExtrudedHexes> stair_step_hexes(const LayeredSpace& space, double edge_m);

}  // namespace strataflow
