#include "kernels/cutting/rounded_position.h"

#include <array>
#include <optional>

#include "kernels/adapters/cgal/exact_position.h"
#include "kernels/cutting/double_double.h"

namespace strataflow {

namespace {

struct Bounded3 {
  BoundedDouble x, y, z;
  const BoundedDouble& operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

Bounded3 difference(const Vec3& a, const Vec3& b) {
  return {BoundedDouble(a.x) - BoundedDouble(b.x), BoundedDouble(a.y) - BoundedDouble(b.y),
          BoundedDouble(a.z) - BoundedDouble(b.z)};
}
Bounded3 cross(const Bounded3& a, const Bounded3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
BoundedDouble dot(const Bounded3& a, const Bounded3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

Bounded3 between(const Vec3& p, const Vec3& q, const BoundedDouble& from, const BoundedDouble& to) {
  const BoundedDouble t = from / (from - to);
  const Bounded3 d = difference(q, p);
  return {BoundedDouble(p.x) + t * d.x, BoundedDouble(p.y) + t * d.y, BoundedDouble(p.z) + t * d.z};
}

Bounded3 meeting_of_planes(const std::array<const Vec3*, 9>& p) {
  // Everything relative to one of the points: short numbers, small errors.
  const Vec3& origin = *p[0];
  Bounded3 normal[3];
  BoundedDouble offset[3];
  for (int i = 0; i < 3; ++i) {
    normal[i] = cross(difference(*p[3 * i + 1], *p[3 * i]), difference(*p[3 * i + 2], *p[3 * i]));
    offset[i] = dot(normal[i], difference(*p[3 * i], origin));
  }
  const Bounded3 c12 = cross(normal[1], normal[2]), c20 = cross(normal[2], normal[0]),
                 c01 = cross(normal[0], normal[1]);
  const BoundedDouble determinant = dot(normal[0], c12);
  const auto along = [&](int axis) {
    return BoundedDouble(origin[axis]) +
           (offset[0] * c12[axis] + offset[1] * c20[axis] + offset[2] * c01[axis]) / determinant;
  };
  return {along(0), along(1), along(2)};
}

/// A coordinate that all the given points share is the answer's too: the sides of a box, which are many.
std::optional<double> shared_coordinate(const std::vector<Vec3>& points, const PointDefinition& d, int axis) {
  const auto same = [&](int first, int count) {
    for (int i = 1; i < count; ++i)
      if (points[d.vertices[first + i]][axis] != points[d.vertices[first]][axis]) return false;
    return true;
  };
  switch (d.kind) {
    case PointDefinition::Kind::vertex:
      return points[d.vertices[0]][axis];
    case PointDefinition::Kind::edge_and_plane:
      if (same(0, 2)) return points[d.vertices[0]][axis];
      if (same(2, 3)) return points[d.vertices[2]][axis];
      return std::nullopt;
    case PointDefinition::Kind::two_edges:
      if (same(0, 2)) return points[d.vertices[0]][axis];
      if (same(2, 2)) return points[d.vertices[2]][axis];
      return std::nullopt;
    case PointDefinition::Kind::three_planes:
      for (int i = 0; i < 9; i += 3)
        if (same(i, 3)) return points[d.vertices[i]][axis];
      return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

Vec3 rounded_position(const std::vector<Vec3>& points, const PointDefinition& d) {
  const auto corner = [&](int i) -> const Vec3& { return points[d.vertices[i]]; };
  Bounded3 near;
  switch (d.kind) {
    case PointDefinition::Kind::vertex:
      return corner(0);
    case PointDefinition::Kind::edge_and_plane: {
      const Bounded3 normal = cross(difference(corner(3), corner(2)), difference(corner(4), corner(2)));
      near = between(corner(0), corner(1), dot(normal, difference(corner(0), corner(2))),
                     dot(normal, difference(corner(1), corner(2))));
      break;
    }
    case PointDefinition::Kind::two_edges: {
      const int axis = static_cast<int>(d.vertices[4]), s = axis == 0 ? 1 : 0, t = axis == 2 ? 1 : 2;
      const Bounded3 along = difference(corner(3), corner(2));
      const auto turn = [&](const Vec3& p) {
        const Bounded3 to = difference(p, corner(2));
        return along[s] * to[t] - along[t] * to[s];
      };
      near = between(corner(0), corner(1), turn(corner(0)), turn(corner(1)));
      break;
    }
    case PointDefinition::Kind::three_planes: {
      std::array<const Vec3*, 9> p;
      for (int i = 0; i < 9; ++i) p[i] = &corner(i);
      near = meeting_of_planes(p);
      break;
    }
  }
  Vec3 rounded;
  ExactPosition exact;
  for (int axis = 0; axis < 3; ++axis) {
    if (const auto shared = shared_coordinate(points, d, axis)) {
      rounded[axis] = *shared + 0.0;  // −0 becomes 0: positions are compared bit by bit
    } else if (rounds_surely(near[axis])) {
      rounded[axis] = near[axis].hi + 0.0;
    } else {
      if (!exact) exact = exact_position(points, d);
      rounded[axis] = nearest_doubles(exact)[axis];
    }
  }
  return rounded;
}

}  // namespace strataflow
