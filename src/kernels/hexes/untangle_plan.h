#pragma once
#include "kernels/hexes/multigrid.h"
#include "kernels/hexes/upright_system.h"

namespace strataflow {

struct UntangledPlan {
  std::vector<double> u, v;  ///< per unknown of the system
  std::uint32_t steps = 0;
  double smallest_determinant = 0;
  bool is_free_of_foldovers = false;  ///< every determinant positive
};

/// Foldover-free optimisation (coudert2024 S44): from (u, v), which may turn tetrahedra over, to a plan that turns none
/// over and distorts little. `guide` stands for the matrix of the linear deformation. Stops as soon as nothing is turned
/// over and the energy falls slowly, or after `most_steps`. The same bits on every schedule.
UntangledPlan untangle_plan(const LabelledTets& tets, const UprightSystem& system,
                            const std::vector<TetGradients>& gradients, const Multigrid& guide, std::vector<double> u,
                            std::vector<double> v, std::size_t most_steps);

}  // namespace strataflow
