#pragma once
#include <cmath>
#include <cstdint>
#include <span>

#include "model/triangle_soup.h"
#include "model/vector3.h"

namespace strataflow {

namespace exact {
int orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
int orientation_2d(double ax, double ay, double bx, double by, double cx, double cy);
int signed_volume_sign(std::span<const Vec3> points, std::span<const Triangle> triangles);
}  // namespace exact

/// Exact sign of det(b − a, c − a, d − a): +1 when d lies on the side of the plane abc that its counter-clockwise
/// normal points to, 0 when the four are coplanar. A forward error bound settles almost every call (Shewchuk 1997,
/// stage A); the rest goes to exact arithmetic.
inline int orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 u = b - a, v = c - a, w = d - a;
  const double vw_x = v.y * w.z, wv_x = v.z * w.y;
  const double vw_y = v.z * w.x, wv_y = v.x * w.z;
  const double vw_z = v.x * w.y, wv_z = v.y * w.x;
  const double determinant = u.x * (vw_x - wv_x) + u.y * (vw_y - wv_y) + u.z * (vw_z - wv_z);
  const double permanent = (std::abs(vw_x) + std::abs(wv_x)) * std::abs(u.x) +
                           (std::abs(vw_y) + std::abs(wv_y)) * std::abs(u.y) +
                           (std::abs(vw_z) + std::abs(wv_z)) * std::abs(u.z);
  constexpr double unit = 0x1.0p-53;
  constexpr double bound = (7.0 + 56.0 * unit) * unit;
  constexpr double safe_from_underflow = 1e-270;
  if (permanent > safe_from_underflow) {
    if (determinant > bound * permanent) return 1;
    if (determinant < -bound * permanent) return -1;
  } else if ((u.x == 0 && v.x == 0 && w.x == 0) || (u.y == 0 && v.y == 0 && w.y == 0) ||
             (u.z == 0 && v.z == 0 && w.z == 0)) {
    return 0;  // all four share a coordinate: the sides of a box, which are many
  }
  return exact::orientation_3d(a, b, c, d);
}

/// Exact sign of the signed area of the plane triangle (a, b, c): +1 counter-clockwise, 0 collinear.
inline int orientation_2d(double ax, double ay, double bx, double by, double cx, double cy) {
  const double left = (ax - cx) * (by - cy), right = (ay - cy) * (bx - cx);
  const double determinant = left - right;
  constexpr double unit = 0x1.0p-53;
  constexpr double bound = (3.0 + 16.0 * unit) * unit;
  constexpr double safe_from_underflow = 1e-270;
  const double sum = std::abs(left) + std::abs(right);
  if (sum > safe_from_underflow) {
    if (determinant > bound * sum) return 1;
    if (determinant < -bound * sum) return -1;
  }
  return exact::orientation_2d(ax, ay, bx, by, cx, cy);
}

/// orientation_2d of three points seen along `axis` (0 x, 1 y, 2 z).
inline int orientation_2d(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
  const int s = axis == 0 ? 1 : 0, t = axis == 2 ? 1 : 2;
  return orientation_2d(a[s], a[t], b[s], b[t], c[s], c[t]);
}

/// An axis along which the triangle abc is seen with non-zero area, or −1 if its three points are collinear.
inline int projection_axis(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = cross(b - a, c - a);
  const double x = std::abs(n.x), y = std::abs(n.y), z = std::abs(n.z);
  int axis = x >= y ? (x >= z ? 0 : 2) : (y >= z ? 1 : 2);
  for (int tries = 0; tries < 3; ++tries, axis = (axis + 1) % 3)
    if (orientation_2d(a, b, c, axis) != 0) return axis;
  return -1;
}

}  // namespace strataflow
