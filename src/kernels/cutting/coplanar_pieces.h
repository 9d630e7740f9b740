#pragma once
#include <cstdint>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

/// The pieces of one cut triangle.
struct CutPieces {
  std::vector<Triangle> triangles;    ///< turned as the triangle they come from
  std::vector<std::uint32_t> pocket;  ///< per piece: which area between segments it lies in
};

/// Where triangles overlap in one plane, the areas between segments are the same in each, but may be triangulated
/// differently: makes all like the first in `overlapping`, which are indices into `pieces`.
void unify_coplanar_pieces(std::vector<CutPieces>& pieces, const std::vector<std::uint32_t>& overlapping);

}  // namespace strataflow
