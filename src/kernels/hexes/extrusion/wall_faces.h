#pragma once
#include <cstdint>
#include <vector>

#include "kernels/hexes/layered_space.h"

namespace strataflow {

/// Per face 4·t + k of layers.tets: the entity of the wall (fault that is followed, or side) it lies on, or no_index.
/// Upright faces of tetrahedra without volume have the wall that the edge they stand on belongs to, also where that
/// wall ends at this edge: a fault that an unconformity cuts off.
std::vector<std::uint32_t> walls_of_faces(const LayeredSpace& space);

}  // namespace strataflow
