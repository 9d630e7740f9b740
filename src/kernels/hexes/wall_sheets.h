#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "kernels/hexes/labelled_tets.h"

namespace strataflow {

/// The surfaces that columns of hexahedra must follow: faults and sides, in sheets without sharp upright edges. Edges
/// and triangles are numbered over all sheets.
struct WallSheets {
  struct Wall {
    Triangle vertices{};
    std::uint32_t facet = 0;  ///< of LabelledTets
    std::uint32_t sheet = 0;
    std::array<std::uint32_t, 2> tets{no_index, no_index};
    std::array<std::uint32_t, 3> edges{};  ///< edge k runs from vertex k to vertex k + 1
  };
  struct Edge {
    std::array<std::uint32_t, 2> points{};  ///< ascending
    std::vector<std::uint32_t> walls;       ///< ascending
  };
  std::vector<Wall> walls;
  std::vector<Edge> edges;
  std::vector<std::uint32_t> sheet_entity;              ///< per sheet
  std::vector<std::vector<std::uint32_t>> point_walls;  ///< per point of the model
  std::vector<std::vector<std::uint32_t>> point_edges;  ///< per point of the model

  /// The other triangle of the sheet at one of its edges, or no_index at the sheet's border.
  std::uint32_t across(std::uint32_t wall, std::uint32_t edge) const {
    for (const std::uint32_t other : edges[edge].walls)
      if (other != wall && walls[other].sheet == walls[wall].sheet) return other;
    return no_index;
  }
  bool is_in_sheet(std::uint32_t edge, std::uint32_t sheet) const {
    for (const std::uint32_t wall : edges[edge].walls)
      if (walls[wall].sheet == sheet) return true;
    return false;
  }
  /// Sheets around a point, ascending.
  std::vector<std::uint32_t> sheets_at(std::uint32_t point) const;
};

/// Triangles of one entity belong to one sheet across an edge that no third one shares, unless it is a steep crease:
/// the corner of a box whose sides are one entity.
WallSheets find_wall_sheets(const LabelledTets& tets);

/// Sine of the least slope of what points can go down by; lines where walls meet that rise less separate what is above
/// from what is below.
inline constexpr double upright_sine = 0.2;

/// Per edge, whether several sheets meet along it and it is upright: points of all of them go down such a line.
std::vector<char> find_upright_lines(const LabelledTets& tets, const WallSheets& sheets);

/// Straight along an upright edge, downwards, as (x, y, −1).
Vec3 down_edge(const LabelledTets& tets, const WallSheets::Edge& edge);

/// Refuses what cannot be made upright, naming the entity: walls within `flat_deg` of horizontal, faults that end
/// downwards on another fault (a Y) or on a side.
Result<void> check_walls(const LabelledTets& tets, const WallSheets& sheets, double flat_deg = 5);

}  // namespace strataflow
