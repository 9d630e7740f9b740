#include "kernels/remeshing/dual/piece_distance.h"

#include <algorithm>
#include <limits>

namespace strataflow {

namespace {

double clamp_ratio(double part, double whole) {
  const double ratio = part / whole;
  return ratio > 0 ? std::min(ratio, 1.0) : 0.0;  // also where both are 0
}

double squared_of_segments(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = d - c, w = a - c;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
  const double s = clamp_ratio(uv * vw - vv * uw, uu * vv - uv * uv);
  const auto from = [&](double at) {
    const Vec3 x = a + at * u, y = nearest_on_segment(x, c, d), z = nearest_on_segment(y, a, b) - y;
    return dot(z, z);
  };
  return std::min({from(s), from(0), from(1)});
}

}  // namespace

Vec3 nearest_on_polygon(const Vec3& p, std::span<const Vec3> polygon) {
  Vec3 nearest = polygon[0];
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const Vec3 x = nearest_on_triangle(p, polygon[0], polygon[k - 1], polygon[k]);
    if (const double d = dot(x - p, x - p); d < smallest) {
      smallest = d;
      nearest = x;
    }
  }
  return nearest;
}

double squared_distance_of_pieces(std::span<const Vec3> a, std::span<const Vec3> b) {
  double smallest = std::numeric_limits<double>::infinity();
  const auto corners_to_face = [&](std::span<const Vec3> corners, std::span<const Vec3> face) {
    if (face.size() < 3) return;
    for (const Vec3& corner : corners) {
      const Vec3 gap = nearest_on_polygon(corner, face) - corner;
      smallest = std::min(smallest, dot(gap, gap));
    }
  };
  corners_to_face(a, b);
  corners_to_face(b, a);
  const auto edge_count = [](std::span<const Vec3> piece) { return piece.size() == 2 ? 1 : piece.size(); };
  for (std::size_t i = 0; i < edge_count(a); ++i)
    for (std::size_t j = 0; j < edge_count(b); ++j)
      smallest = std::min(smallest, squared_of_segments(a[i], a[(i + 1) % a.size()], b[j], b[(j + 1) % b.size()]));
  return smallest;
}

}  // namespace strataflow
