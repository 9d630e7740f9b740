#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "model/hex_grid.h"

namespace strataflow {

/// Two live cells that share area.
struct CellContact {
  std::uint32_t cell_0 = 0, cell_1 = 0;  ///< hexahedra
  std::uint32_t side_0 = 0, side_1 = 0;  ///< over the plan side of their quads; 4 for the bottom, 5 for the top
  std::uint32_t fault = no_index;        ///< entity of the mesh they touch across
  std::uint32_t is_whole = 1;            ///< 0: the sides overlap in part
  Vec3 area;                             ///< vector area of what they share, out of cell_0; m²
  static constexpr bool is_flat = true;
};

/// The cell of every column and layer: column · layers + layer. Fails with invalid_input unless each place has one
/// cell, a hexahedron with corners in range.
Result<std::vector<std::uint32_t>> cells_by_column(const HexGrid& grid);

/// The corners of a cell's side, counter-clockwise seen from outside; sides as in CellContact. The first two of sides
/// 0…3 are the lower ones.
std::array<Vec3, 4> side_corners(const VolumeMesh& mesh, std::uint32_t cell, std::uint32_t side);

/// Half the sum of the cross products: its length is the area of a plane face.
Vec3 vector_area(const std::array<Vec3, 4>& corners);

/// What two sides of cells have in common, as a vector along the mean normal of `first` (which looks out of its cell)
/// and the reversed `second`: both are projected on the plane across it and clipped, which is exact on a plane fault.
Vec3 overlap_area(const std::array<Vec3, 4>& first, const std::array<Vec3, 4>& second);

/// All contacts: up and down inside columns, over dead cells as if they were not there, and sideways between the
/// columns of neighbouring quads, whole sides or, across an offset fault, the parts that overlap. `opposite` is
/// opposite_half_edges of the plan. First by columns, then by plan edges, from below.
std::vector<CellContact> find_cell_contacts(const HexGrid& grid, const std::vector<std::uint32_t>& cells,
                                            const std::vector<std::uint32_t>& opposite);

}  // namespace strataflow
