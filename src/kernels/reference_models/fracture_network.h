#pragma once
#include <cstdint>

#include "base/result.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// Two tilted horizons and 200 planar fractures in a box of 13 × 11 × 4 km (pellerin2014 §4.3, DFN): three steep sets
/// and a flat one, 500 to 3000 m across, clipped by the box. Every tenth of them goes with the one before it: meets it
/// by 0.1 m, misses it by 0.5 m or crosses it at 3°. Entities H1, H2, F1 … F200 and the sides of the box. The surfaces
/// as an interpreter has them: none is cut. `extent_ratio` is added to the size of the fractures.
TriangleSoup raw_fracture_network(double edge_m, std::uint64_t seed, double extent_ratio = 0);

/// The same, cut along everything they share and conforming; fractures end inside layers.
Result<TriangleSoup> fracture_network(double edge_m, std::uint64_t seed);

}  // namespace strataflow
