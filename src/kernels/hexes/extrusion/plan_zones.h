#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "kernels/hexes/labelled_tets.h"
#include "model/quad_mesh.h"

namespace strataflow {

/// Quads of a plan that stand for something with a width: the row between both sides of a volumetric fault (coudert2024
/// S20), the footprint of a well (S21).
struct PlanZones {
  std::vector<Entity> zones;           ///< a fault's name is that of the model's entity
  std::vector<std::int32_t> zone_of;   ///< per quad: index into zones, −1 for none
  std::vector<char> is_strip_feature;  ///< per feature: a side or an end of a volumetric fault, no fault to be cut
  std::vector<char> is_on_strip;       ///< per point
};

/// Finds strips by walking across from their left sides, `strip_quads` quads up to the right ones, and footprints by
/// the closed curves around wells. Needs indices in range.
PlanZones find_plan_zones(const QuadMesh& plan);

}  // namespace strataflow
