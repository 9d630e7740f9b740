#pragma once
#include <cstdint>
#include <vector>

#include "kernels/topology/building/edge_table.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// Triangles split into surfaces: components across edges where exactly two triangles of one label meet (a
/// patch, or the patches that coincide there).
struct SurfacePartition {
  std::vector<std::uint32_t> surface_of;  ///< per triangle; surfaces are numbered by their first triangle
  std::vector<char> is_flipped;           ///< per triangle: turn it over to agree with its surface
  std::vector<char> is_feature;           ///< per edge: it bounds surfaces
  std::uint32_t surface_count = 0;
  std::vector<std::uint32_t> non_orientable;  ///< surfaces with no coherent orientation (Moebius strips), ascending
};

/// Flood fill with orientation (pellerin2014 §2.1 builder steps 2–3, euler1999 §2.2.1). The orientation that most
/// of a surface's triangles came with wins; the first triangle's on a tie.
SurfacePartition build_surfaces(const EdgeTable& edges, const std::vector<Triangle>& triangles,
                                const std::vector<std::uint32_t>& triangle_label);

}  // namespace strataflow
