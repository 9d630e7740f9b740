#pragma once
#include <algorithm>
#include <charconv>
#include <string>

#include "kernels/adapters/cgal/exact_predicates.h"
#include "model/vector3.h"

namespace strataflow {

/// Exact sign of the area of abc seen from above.
inline int turn(const Vec3& a, const Vec3& b, const Vec3& c) { return orientation_2d(a.x, a.y, b.x, b.y, c.x, c.y); }

/// Where on ab the point nearest to p lies, in [0, 1].
inline double nearest_parameter(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double squared = dot(b - a, b - a);
  return squared > 0 ? std::clamp(dot(p - a, b - a) / squared, 0.0, 1.0) : 0.0;
}

inline Vec3 between(const Vec3& a, const Vec3& b, double t) { return a + t * (b - a); }

inline double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  return length(p - between(a, b, nearest_parameter(p, a, b)));
}

/// Whether ab and cd cross inside both.
inline bool cross_properly(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

/// Whether p lies in the triangle abc or on it, even if abc is flat.
inline bool closed_triangle_holds(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  if (p.x < std::min({a.x, b.x, c.x}) || p.x > std::max({a.x, b.x, c.x}) || p.y < std::min({a.y, b.y, c.y}) ||
      p.y > std::max({a.y, b.y, c.y}))
    return false;
  const int around = turn(a, b, c);
  const int ab = turn(a, b, p), bc = turn(b, c, p), ca = turn(c, a, p);
  if (around == 0) return ab == 0 && bc == 0 && ca == 0;
  return ab * around >= 0 && bc * around >= 0 && ca * around >= 0;
}

/// Four significant digits, for people.
inline std::string short_number(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 4);
  return std::string(text, end.ptr);
}

/// "(x, y)" in the file's own coordinates.
inline std::string place_text(const Vec3& p, const Vec3& origin = {}) {
  const auto fixed = [](double value) {
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, 2);
    return end.ec == std::errc() ? std::string(text, end.ptr) : short_number(value);
  };
  return "(" + fixed(p.x + origin.x) + ", " + fixed(p.y + origin.y) + ")";
}

}  // namespace strataflow
