#pragma once
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "model/vector3.h"

namespace strataflow {

/// The part of a triangle that lies in a cell, in one piece (triangles and cells are convex).
struct SurfacePiece {
  std::uint32_t triangle = 0;  ///< of the model
  std::uint32_t edges = 0;     ///< bit k: edge k of the triangle, from its corner k on, passes through the cell
  double area_m2 = 0;
  static constexpr bool is_flat = true;
};

/// The part of an edge of a line that lies in a cell.
struct LinePiece {
  std::uint32_t line = 0;
  std::uint32_t edge = 0;  ///< along the line: from its vertex `edge` to the next
  std::uint32_t ends = 0;  ///< bit 0: its first vertex lies in the cell, bit 1: its second
  std::uint32_t zero = 0;  ///< no padding
  double length_m = 0;
  static constexpr bool is_flat = true;
};

/// Space labelled into cells, and what of a model lies in each: voxels, balls, Voronoi cells, anything convex. Whoever
/// labels fills this, the box's surfaces and lines included; count_in_cells does the rest. The pieces of cell c are
/// those from first_…[c] up to first_…[c + 1].
struct CellPieces {
  std::vector<Vec3> sites;  ///< per cell: a point of it, which tells its region where it holds no piece
  double resolution_m = 0;  ///< width of a cell: cube root of its mean volume
  std::vector<std::uint32_t> first_surface{0}, first_line{0}, first_corner{0};
  std::vector<SurfacePiece> surface_pieces;
  std::vector<LinePiece> line_pieces;
  std::vector<std::uint32_t> corners;  ///< of the model

  std::size_t cell_count() const { return sites.size(); }
  std::span<const SurfacePiece> surfaces_in(std::size_t cell) const {
    return {surface_pieces.data() + first_surface[cell], surface_pieces.data() + first_surface[cell + 1]};
  }
  std::span<const LinePiece> lines_in(std::size_t cell) const {
    return {line_pieces.data() + first_line[cell], line_pieces.data() + first_line[cell + 1]};
  }
  std::span<const std::uint32_t> corners_in(std::size_t cell) const {
    return {corners.data() + first_corner[cell], corners.data() + first_corner[cell + 1]};
  }
};

/// Puts (cell, piece) pairs in the order of cells, keeping the order of each cell's pieces.
template <class Piece>
void group_by_cell(const std::vector<std::pair<std::uint32_t, Piece>>& pairs, std::size_t cell_count,
                   std::vector<std::uint32_t>& first, std::vector<Piece>& pieces) {
  first.assign(cell_count + 1, 0);
  for (const auto& [cell, piece] : pairs) ++first[cell + 1];
  for (std::size_t c = 0; c < cell_count; ++c) first[c + 1] += first[c];
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  pieces.resize(pairs.size());
  for (const auto& [cell, piece] : pairs) pieces[next[cell]++] = piece;
}

}  // namespace strataflow
