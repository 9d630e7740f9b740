#pragma once
#include <algorithm>
#include <array>
#include <compare>
#include <cstdint>

namespace strataflow {

/// A point known by what passes through it, not yet by coordinates: how intersections stay exact until they are
/// rounded, once (euler1999 §2.6). Vertices are indices into an array of input points.
struct PointDefinition {
  enum class Kind : std::uint32_t {
    vertex,          ///< the input point vertices[0]
    edge_and_plane,  ///< edge 0–1 with the plane 2 3 4, which separates its ends
    two_edges,       ///< edge 0–1 with edge 2–3 of the same plane, crossing when seen along axis vertices[4]
    three_planes     ///< planes 0 1 2, 3 4 5 and 6 7 8, meeting in one point
  };
  Kind kind = Kind::vertex;
  std::array<std::uint32_t, 9> vertices{};
  friend constexpr auto operator<=>(const PointDefinition&, const PointDefinition&) = default;
};

/// Definitions are written one way only, so that equal ones compare equal: vertices ascend inside edges and planes,
/// planes ascend, the first edge of two is the smaller.
inline PointDefinition vertex_point(std::uint32_t v) { return {PointDefinition::Kind::vertex, {v}}; }

inline PointDefinition edge_and_plane_point(std::array<std::uint32_t, 2> edge, std::array<std::uint32_t, 3> plane) {
  std::sort(edge.begin(), edge.end());
  std::sort(plane.begin(), plane.end());
  return {PointDefinition::Kind::edge_and_plane, {edge[0], edge[1], plane[0], plane[1], plane[2]}};
}

inline PointDefinition two_edges_point(std::array<std::uint32_t, 2> a, std::array<std::uint32_t, 2> b, int axis) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  if (b < a) std::swap(a, b);
  return {PointDefinition::Kind::two_edges, {a[0], a[1], b[0], b[1], static_cast<std::uint32_t>(axis)}};
}

inline PointDefinition three_planes_point(std::array<std::array<std::uint32_t, 3>, 3> planes) {
  for (auto& plane : planes) std::sort(plane.begin(), plane.end());
  std::sort(planes.begin(), planes.end());
  PointDefinition point{PointDefinition::Kind::three_planes, {}};
  for (std::size_t i = 0; i < 9; ++i) point.vertices[i] = planes[i / 3][i % 3];
  return point;
}

}  // namespace strataflow
