#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "model/hex_grid.h"

namespace strataflow {

/// What a cell of layers is: its upright edges all open, all closed, or some of both; `inverted` where the determinant
/// of a corner with an open edge is not positive.
enum class CellState : std::uint8_t { whole, wedge, dead, inverted };

/// Per cell. An upright edge has closed when it is shorter than 1e-8 of the plan's mean edge.
std::vector<CellState> cell_states(const HexGrid& grid);

/// Per vertex, whether an upright edge that has closed ends there.
std::vector<char> vertices_of_closed_edges(const HexGrid& grid);

/// Mean length of the sides of the plan's quads, metres.
double mean_plan_edge_m(const QuadMesh& plan);

/// The corners of a hexahedron.
std::array<Vec3, 8> hex_corners(const VolumeMesh& mesh, std::size_t cell);

}  // namespace strataflow
