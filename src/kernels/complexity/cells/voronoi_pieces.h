#pragma once
#include <cstdint>
#include <vector>

#include "kernels/complexity/cells/cell_pieces.h"
#include "kernels/topology/building/edge_table.h"
#include "kernels/voronoi/site_neighbours.h"
#include "model/box3.h"
#include "model/structural_model.h"

namespace strataflow {

/// Sites of a centroidal Voronoi tessellation of a box (pellerin2014 §2.10d), from a random start. Needs a box with
/// room inside and at least one cell.
std::vector<Vec3> spread_in_box(const Box3& box, std::uint32_t cells, std::uint64_t seed);

/// What lies in the Voronoi cell of each site. A corner as near to several sites belongs to one of them.
CellPieces cut_by_voronoi(const StructuralModel& model, const EdgeTable& edges, const SiteNeighbours& sites);

}  // namespace strataflow
