#include "kernels/adapters/cgal/exact_position.h"

#include <CGAL/Exact_rational.h>

#include <bit>
#include <cmath>
#include <limits>

namespace strataflow {

namespace {
using Number = CGAL::Exact_rational;

struct Exact3 {
  Number x, y, z;
  const Number& operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

Exact3 exact(const Vec3& p) { return {Number(p.x), Number(p.y), Number(p.z)}; }
Exact3 operator-(const Exact3& a, const Exact3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Exact3 cross(const Exact3& a, const Exact3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Number dot(const Exact3& a, const Exact3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Exact3 between(const Exact3& p, const Exact3& q, const Number& t) {
  return {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), p.z + t * (q.z - p.z)};
}

Number turn(const Exact3& a, const Exact3& b, const Exact3& c, int axis) {
  const int s = axis == 0 ? 1 : 0, t = axis == 2 ? 1 : 2;
  return (a[s] - c[s]) * (b[t] - c[t]) - (a[t] - c[t]) * (b[s] - c[s]);
}

/// The double nearest to a rational, ties to even.
double nearest(const Number& value) {
  double guess = CGAL::to_double(value);
  if (!std::isfinite(guess)) return guess;
  // Step to the doubles around the value, then choose by the exact midpoint.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  while (Number(guess) > value) guess = std::nextafter(guess, -infinity);
  double above = std::nextafter(guess, infinity);
  while (Number(above) <= value) {
    guess = above;
    above = std::nextafter(above, infinity);
  }
  const Number twice = value + value, sum = Number(guess) + Number(above);
  if (twice < sum) return guess + 0.0;
  if (twice > sum) return above + 0.0;
  return (std::bit_cast<std::uint64_t>(guess) & 1) == 0 ? guess + 0.0 : above + 0.0;
}

}  // namespace

struct ExactPosition::Coordinates : Exact3 {
  explicit Coordinates(Exact3 p) : Exact3(std::move(p)) {}
};

ExactPosition exact_position(const std::vector<Vec3>& points, const PointDefinition& d) {
  const auto corner = [&](int i) { return exact(points[d.vertices[i]]); };
  const auto made = [](Exact3 p) { return ExactPosition(std::make_shared<ExactPosition::Coordinates>(std::move(p))); };
  switch (d.kind) {
    case PointDefinition::Kind::vertex:
      return made(corner(0));
    case PointDefinition::Kind::edge_and_plane: {
      const Exact3 p = corner(0), q = corner(1), a = corner(2);
      const Exact3 normal = cross(corner(3) - a, corner(4) - a);
      const Number from = dot(normal, p - a), to = dot(normal, q - a);
      return made(between(p, q, from / (from - to)));
    }
    case PointDefinition::Kind::two_edges: {
      const Exact3 p = corner(0), q = corner(1), r = corner(2), s = corner(3);
      const int axis = static_cast<int>(d.vertices[4]);
      const Number from = turn(r, s, p, axis), to = turn(r, s, q, axis);
      return made(between(p, q, from / (from - to)));
    }
    case PointDefinition::Kind::three_planes: {
      Exact3 normal[3];
      Number offset[3];
      for (int i = 0; i < 3; ++i) {
        const Exact3 a = corner(3 * i);
        normal[i] = cross(corner(3 * i + 1) - a, corner(3 * i + 2) - a);
        offset[i] = dot(normal[i], a);
      }
      const Exact3 c12 = cross(normal[1], normal[2]), c20 = cross(normal[2], normal[0]), c01 = cross(normal[0], normal[1]);
      const Number determinant = dot(normal[0], c12);
      const auto along = [&](int axis) -> Number {
        return (offset[0] * c12[axis] + offset[1] * c20[axis] + offset[2] * c01[axis]) / determinant;
      };
      return made({along(0), along(1), along(2)});
    }
  }
  return {};
}

int compare_along(const ExactPosition& a, const ExactPosition& b, int axis) {
  return static_cast<int>(CGAL::compare((*a)[axis], (*b)[axis]));
}

int compare(const ExactPosition& a, const ExactPosition& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (const int order = compare_along(a, b, axis); order != 0) return order;
  return 0;
}

int orientation_2d(const ExactPosition& a, const ExactPosition& b, const ExactPosition& c, int axis) {
  return static_cast<int>(CGAL::sign(turn(*a, *b, *c, axis)));
}

Vec3 nearest_doubles(const ExactPosition& a) { return {nearest((*a).x), nearest((*a).y), nearest((*a).z)}; }

}  // namespace strataflow
