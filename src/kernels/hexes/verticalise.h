#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "kernels/hexes/trace_walls.h"

namespace strataflow {

struct VerticaliseOptions {
  std::int64_t untangling_steps = 600;  ///< ≥ 0: of the foldover-free optimisation, if tetrahedra turn over
};

/// The plan in which faults and sides stand upright.
struct UprightPlan {
  std::vector<Vec3> plan;       ///< per point: (u, v, 0)
  WallSheets sheets;
  TracedWalls traced;
  bool is_identity = false;     ///< everything stood upright already
  std::uint32_t flipped_by_linear = 0;  ///< tetrahedra the linear deformation turned over
  std::uint32_t untangling_steps = 0;
  std::uint32_t left_turned_over = 0;   ///< tetrahedra, of 1/10 000 of the volume at most, that stay turned over
  double smallest_determinant = 1;      ///< of the deformation's gradient
};

/// Whether no wall leans: then the plan is that of the model.
bool stands_upright(const LabelledTets& tets);

/// The least distorting displacement of U and V that makes every fault and side weakly vertical: its points lie over
/// the polyline of its lower edges (coudert2024 S16–S18). Z stays. One factorisation, two right-hand sides; a
/// foldover-free optimisation (S44) when tetrahedra turn over. `tets` should have gone through separate_walls. Fails
/// with: unsupported (walls that cannot stand upright, by name), geometry_failed (tetrahedra that stay turned over).
Result<UprightPlan> verticalise(const LabelledTets& tets, const VerticaliseOptions& options = {});

}  // namespace strataflow
