#include "kernels/reference_models/polygon_triangulation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/internal_error.h"

namespace strataflow {
namespace {

constexpr double flat_m = 1e-9;  // nearer to a line than this is on it; points of one column differ by 1e-8 at least

/// Distance of c from the line a → b, positive on its left.
double height_over(const PolygonNode& a, const PolygonNode& b, const PolygonNode& c) {
  const double du = b.u - a.u, dv = b.v - a.v;
  const double long_side = std::sqrt(du * du + dv * dv);
  return long_side > 0 ? (du * (c.v - a.v) - dv * (c.u - a.u)) / long_side : 0.0;
}

/// Grows with the smallest angle: 4√3 area / (sum of squared sides).
double shape(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double sides = dot(b - a, b - a) + dot(c - b, c - b) + dot(a - c, a - c);
  return sides > 0 ? length(cross(b - a, c - a)) / sides : 0.0;
}

bool is_ear(const std::vector<PolygonNode>& polygon, std::size_t at) {
  const std::size_t count = polygon.size();
  const std::size_t before = (at + count - 1) % count, after = (at + 1) % count;
  const PolygonNode &a = polygon[before], &b = polygon[at], &c = polygon[after];
  if (!(height_over(a, c, b) < -flat_m)) return false;
  for (std::size_t i = 0; i < count; ++i) {
    if (i == before || i == at || i == after) continue;
    const PolygonNode& d = polygon[i];
    if (height_over(a, b, d) >= -flat_m && height_over(b, c, d) >= -flat_m && height_over(c, a, d) >= -flat_m)
      return false;
  }
  return true;
}

}  // namespace

void triangulate_polygon(std::vector<PolygonNode>& polygon, const std::vector<Vec3>& points,
                         std::vector<Triangle>& triangles) {
  while (polygon.size() > 3) {
    std::size_t best = polygon.size();
    double best_shape = -1;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      if (!is_ear(polygon, i)) continue;
      const std::size_t count = polygon.size();
      const double candidate = shape(points[polygon[(i + count - 1) % count].point], points[polygon[i].point],
                                     points[polygon[(i + 1) % count].point]);
      if (candidate > best_shape) {
        best = i;
        best_shape = candidate;
      }
    }
    STRATAFLOW_ASSERT(best < polygon.size(), "a polygon of a reference model has no ear");
    const std::size_t count = polygon.size();
    triangles.push_back(
        {polygon[(best + count - 1) % count].point, polygon[best].point, polygon[(best + 1) % count].point});
    polygon.erase(polygon.begin() + static_cast<std::ptrdiff_t>(best));
  }
  if (polygon.size() == 3) triangles.push_back({polygon[0].point, polygon[1].point, polygon[2].point});
  polygon.clear();
}

void triangulate_strip(const std::vector<std::uint32_t>& left, const std::vector<std::uint32_t>& right,
                       const std::vector<Vec3>& points, std::vector<Triangle>& triangles) {
  std::size_t l = 0, r = 0;
  while (l + 1 < left.size() || r + 1 < right.size()) {
    bool is_left_next = r + 1 == right.size();
    if (!is_left_next && l + 1 < left.size()) {
      const Vec3 up_left = points[left[l + 1]] - points[right[r]];
      const Vec3 up_right = points[right[r + 1]] - points[left[l]];
      is_left_next = dot(up_left, up_left) <= dot(up_right, up_right);
    }
    const std::uint32_t next = is_left_next ? left[l + 1] : right[r + 1];
    if (left[l] != right[r] && next != left[l] && next != right[r]) triangles.push_back({left[l], right[r], next});
    ++(is_left_next ? l : r);
  }
}

}  // namespace strataflow
