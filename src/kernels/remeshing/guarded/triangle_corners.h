#pragma once
#include <algorithm>
#include <cstdint>

#include "kernels/intersection/bounding_volume_tree.h"
#include "model/triangle_soup.h"

namespace strataflow {

inline bool has(const Triangle& t, std::uint32_t v) { return t[0] == v || t[1] == v || t[2] == v; }

/// The corner other than a and b.
inline std::uint32_t third_of(const Triangle& t, std::uint32_t a, std::uint32_t b) {
  return t[0] ^ t[1] ^ t[2] ^ a ^ b;
}

/// Whether its edge between a and b runs from a to b.
inline bool runs_along(const Triangle& t, std::uint32_t a, std::uint32_t b) {
  return (t[0] == a && t[1] == b) || (t[1] == a && t[2] == b) || (t[2] == a && t[0] == b);
}

inline void widen(FloatBox& box, const FloatBox& other) {
  for (int axis = 0; axis < 3; ++axis) {
    box.low[axis] = std::min(box.low[axis], other.low[axis]);
    box.high[axis] = std::max(box.high[axis], other.high[axis]);
  }
}

}  // namespace strataflow
