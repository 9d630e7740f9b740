#pragma once
#include <cstdint>
#include <string_view>
#include <vector>

#include "kernels/remeshing/dual/cell_components.h"

namespace strataflow {

/// What keeps a cell from seeing a surface as a disc that meets its neighbours in arcs (pellerin2014 §2.7.5).
enum class BallCheck : std::uint8_t {
  several_components,     ///< the surface comes in several parts
  not_a_disc,             ///< Euler characteristic of a part other than 1
  several_borders,        ///< a part has more than one border
  several_chains,         ///< it meets one neighbour cell in several parts
  closed_chain,           ///< it meets a neighbour cell in a closed curve
  repeated_corner,        ///< it meets two neighbours at once at several points
  several_arcs,           ///< the surface's border crosses the cell more than once
  closed_line,            ///< a whole border of the surface lies in the cell
  several_border_points,  ///< the surface's border meets one neighbour cell more than once
  several_corners,        ///< lines link several corners inside the cell; told of one of the surfaces there
  several_sheets          ///< surfaces in the cell do not touch each other there; told of the first of the others
};

std::string_view to_string(BallCheck check);

struct BallFailure {
  std::uint32_t site = 0;
  std::uint32_t surface = 0;
  BallCheck check = BallCheck::several_components;
  friend constexpr auto operator<=>(const BallFailure&, const BallFailure&) = default;
};

/// Every failure of every cell, ascending, none twice. If there is none but several_sheets and no points were merged,
/// the dual of every surface is homeomorphic to it.
std::vector<BallFailure> check_ball_property(const StructuralModel& model, const RestrictedDiagram& diagram,
                                             const CellComponents& components);

}  // namespace strataflow
