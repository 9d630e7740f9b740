#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

/// Triangles around one edge, in the order of increasing angle about the direction from its lower to its higher
/// vertex, starting from the first given.
struct RadialOrder {
  std::vector<std::uint32_t> half_edges;
  /// Two triangles leave the edge in the same direction, or one has no area: the order is unknown ("type 3" of
  /// euler1999 §2.2.2) and half_edges is as given.
  bool is_ambiguous = false;
};

/// Sorts with exact predicates only, never with angles (euler1999 §2.2.2 step 4).
RadialOrder radial_order(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                         std::span<const std::uint32_t> half_edges);

}  // namespace strataflow
