#pragma once
#include <array>
#include <string>
#include <vector>

#include "base/result.h"
#include "kernels/hexes/layered_space.h"
#include "model/input_data.h"
#include "model/quad_mesh.h"

namespace strataflow {

/// Where a plan is to have shorter edges.
struct RefinementTarget {
  std::string name;
  double edge_m = 0;                              ///< wanted there
  double within_m = 0;                            ///< as far as this from it
  std::vector<std::array<Vec3, 2>> segments;      ///< in the plan; a point is a segment of no length
  std::vector<std::array<Vec3, 3>> areas;         ///< in the plan, all of it is wanted
};

/// The target of a name: a well, a set of points or a line of the input, a fault of the model by its trace, or a region
/// by all it lies under. Of several things of that name, all. Fails with invalid_options if there is none, or if wells
/// and points lie beside the model.
Result<RefinementTarget> refinement_target(const UprightModel& upright, const InputData& input, std::string name,
                                           double edge_m, double within_m);

/// A plan of quads refined until the edges near every target are nearer to what it asks for than to three times that
/// (coudert2024 S10, S23; refine_quads). Quads of volumetric faults stay as they are, so that these stay as many cells
/// thick as they are (R27). Features keep their chains. Fails with geometry_failed when that takes more than 2²² quads.
Result<QuadMesh> refine_near_targets(const QuadMesh& plan, const std::vector<RefinementTarget>& targets);

}  // namespace strataflow
