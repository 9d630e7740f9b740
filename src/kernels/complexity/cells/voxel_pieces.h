#pragma once
#include "kernels/complexity/cells/cell_pieces.h"
#include "kernels/complexity/cells/voxel_grid.h"
#include "model/structural_model.h"

namespace strataflow {

/// What lies in each voxel. What lies in the plane between two voxels belongs to the upper one; a triangle that only
/// touches a voxel has no piece in it. Needs a grid around the whole model.
CellPieces cut_by_voxels(const StructuralModel& model, const VoxelGrid& grid);

}  // namespace strataflow
