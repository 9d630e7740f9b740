#pragma once
#include <algorithm>
#include <utility>

#include "model/vector3.h"

namespace strataflow {

/// The point of a triangle nearest to p.
inline Vec3 nearest_point(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = cross(b - a, c - a);
  if (dot(n, cross(b - a, p - a)) >= 0 && dot(n, cross(c - b, p - b)) >= 0 && dot(n, cross(a - c, p - c)) >= 0)
    return p - (dot(n, p - a) / dot(n, n)) * n;
  Vec3 best = a;
  for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}}) {
    const Vec3 along = to - from;
    const Vec3 q = from + std::clamp(dot(p - from, along) / dot(along, along), 0.0, 1.0) * along;
    if (length(q - p) < length(best - p)) best = q;
  }
  return best;
}

}  // namespace strataflow
