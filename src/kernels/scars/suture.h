#pragma once
#include <cstdint>
#include <vector>

#include "kernels/scars/pair_borders.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// A soup whose lips are sewn together (euler1999 §2.5.2).
struct SewnSoup {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> triangle_patch;  ///< patches joined by a seam carry the lowest of their numbers
  std::vector<std::uint32_t> mates;           ///< as find_mates, seams included
  std::vector<LipPair> pairs;                 ///< those sewn
  std::vector<RefusedLip> refused;            ///< lips left open so that others can stay apart
};

/// Joins the stars on the two sides of every pair: all corners that are linked across edges get the lowest point of
/// theirs. Stars linked by their vertex only keep two points (rule F2). A pair whose sewing would glue two unpaired
/// edges by their ends is left open, the least flat first.
SewnSoup suture(const TriangleSoup& soup, const std::vector<std::uint32_t>& mates, std::vector<LipPair> pairs);

}  // namespace strataflow
