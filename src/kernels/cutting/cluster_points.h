#pragma once
#include <cstdint>
#include <vector>

#include "model/vector3.h"

namespace strataflow {

/// Which point each point becomes.
struct PointClusters {
  std::vector<std::uint32_t> representative;  ///< per point; itself where it stays
  std::uint64_t merged_count = 0;             ///< points that became another one
  double largest_move_m = 0;
};

/// Merges points closer than `tolerance_m` (euler1999 §2.3.5, without its dependence on order and its drift). Fixed
/// points stay and never merge with each other; a free point goes to the nearest fixed one in reach, else to the
/// nearest free one that stays. Free points that stay are chosen in lexicographic order, so no point moves further
/// than the tolerance, and the result does not depend on the order of the points. Ties go to the lexicographically
/// smaller position, then the lower index. `is_fixed` may be empty: none is.
PointClusters cluster_points(const std::vector<Vec3>& points, const std::vector<char>& is_fixed, double tolerance_m);

}  // namespace strataflow
