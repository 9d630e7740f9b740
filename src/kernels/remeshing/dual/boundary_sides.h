#pragma once
#include <cstdint>
#include <vector>

#include "base/id.h"
#include "model/structural_model.h"

namespace strataflow {

/// Per surface: the side of the box around the volume of interest it is part of, named by its first surface; no_index
/// off the box. The box's are the surfaces of features with the role boundary; where the model has none, those with
/// the universe on one side only. Neighbours of one feature that face within 25 degrees of each other are one side.
std::vector<std::uint32_t> find_boundary_sides(const StructuralModel& model);

}  // namespace strataflow
