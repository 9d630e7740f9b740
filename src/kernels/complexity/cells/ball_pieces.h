#pragma once
#include <vector>

#include "kernels/complexity/cells/cell_pieces.h"
#include "model/structural_model.h"

namespace strataflow {

/// What lies inside balls of one radius around the centres. Balls may overlap and need not fill the model.
CellPieces cut_by_balls(const StructuralModel& model, const std::vector<Vec3>& centres, double radius_m);

}  // namespace strataflow
