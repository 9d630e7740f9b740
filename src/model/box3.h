#pragma once
#include <algorithm>
#include <limits>

#include "model/vector3.h"

namespace strataflow {

/// An axis-aligned box; empty until it takes a point.
struct Box3 {
  Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};
  static constexpr bool is_flat = true;

  void take(const Vec3& p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  void take(const Box3& other) {
    take(other.low);
    take(other.high);
  }
  bool is_empty() const { return !(low.x <= high.x); }
  /// Length of the diagonal, metres; 0 for an empty box.
  double diagonal_m() const { return is_empty() ? 0.0 : length(high - low); }
  Vec3 centre() const { return is_empty() ? Vec3{} : 0.5 * (low + high); }
};

inline bool overlap(const Box3& a, const Box3& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y &&
         a.low.z <= b.high.z && b.low.z <= a.high.z;
}

}  // namespace strataflow
