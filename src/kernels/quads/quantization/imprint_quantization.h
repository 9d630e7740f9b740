#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "kernels/quads/quantization/quantize_map.h"
#include "model/corner_map.h"
#include "model/feature_mesh.h"

namespace strataflow {

/// A grid-preserving map on a refinement of the mesh it came from.
struct ImprintedMap {
  FeatureMesh mesh;  ///< the same points first, then points on its edges; features, corners and axes unchanged
  std::vector<std::array<std::uint32_t, 2>> on_edge;  ///< per new point: the ends of the edge that it lies on
  CornerMap map;  ///< transitions exact in double arithmetic, all translations and kept points integers
};

/// Direct transfer (coudert2024 S43): lays the decimated triangles over the mesh, along straight paths in the map,
/// splits both where they cross and carries the integer vectors over, affine on each decimated triangle. It needs no
/// solve and is valid by construction: no triangle of either is degenerate. Paths that pass an edge's end closer
/// than 1e-6 of the edge go through the end, so that no slivers arise.
/// Needs a quantization with `keep_shape` if the map has free curved boundaries or features off their axes; such
/// features stay as they are and are listed in `unmet_features` if they could not be aligned.
/// Fails with geometry_failed (the triangle named) where rounding to doubles spoils a triangle.
Result<ImprintedMap> imprint_quantization(const FeatureMesh& mesh, const CornerMap& map,
                                          const Quantization& quantization);

}  // namespace strataflow
