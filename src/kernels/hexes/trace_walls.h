#pragma once
#include <vector>

#include "kernels/hexes/wall_sheets.h"

namespace strataflow {

/// What holds a point of a wall upright: U = weight · U(org) + (1 − weight) · U(dest) (coudert2024 2.2; the weight is
/// that of org). Where two walls meet, org and dest are the next point down the line they share.
struct UprightConstraint {
  std::uint32_t point = 0, org = 0, dest = 0;
  double weight = 1;
  std::uint32_t sheet = 0;
};

struct TracedWalls {
  std::vector<UprightConstraint> constraints;  ///< by point; one per point at most
  /// Edges through which the field leaves its sheet downwards: what the plan follows. Ascending by sheet, edge.
  struct LowerEdge {
    std::uint32_t sheet = 0, edge = 0;
  };
  std::vector<LowerEdge> lower_edges;
  std::uint32_t conflicts = 0;  ///< points inside several sheets that share no line there: the first sheet holds
  std::uint32_t stuck = 0;      ///< streamlines that end inside their sheet: the point is free
};

/// Follows the field down every sheet from each of its points to the edge it leaves by (coudert2024 S17).
TracedWalls trace_walls(const LabelledTets& tets, const WallSheets& sheets, const std::vector<Vec3>& gravity);

}  // namespace strataflow
