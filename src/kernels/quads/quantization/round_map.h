#pragma once
#include "base/result.h"
#include "kernels/quads/quantization/flat_mesh.h"
#include "model/corner_map.h"
#include "model/feature_mesh.h"

namespace strataflow {

/// The map in whole steps of a power of two (about 1e-13 of its extent), made exactly closed and seamless: what was
/// lost to rounding is pushed along shortest paths (S42 at the scale of rounding). Half-edges whose axis the map
/// respects up to 1e-9 of its extent respect it exactly afterwards.
/// Fails with invalid_input, naming the place: not manifold, not seamless to 1e-6 of its extent, or a triangle that is
/// not positive.
Result<FlatMesh> round_map(const FeatureMesh& mesh, const CornerMap& map);

}  // namespace strataflow
