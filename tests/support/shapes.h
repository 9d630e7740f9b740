#pragma once
#include <array>
#include <initializer_list>
#include <string>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow::support {

/// Adds an empty entity with one patch and returns the patch.
inline std::uint32_t add_patch(TriangleSoup& soup, const std::string& name, Role role = Role::unknown) {
  soup.entities.push_back({name, role});
  soup.patch_entity.push_back(static_cast<std::uint32_t>(soup.entities.size() - 1));
  return static_cast<std::uint32_t>(soup.patch_entity.size() - 1);
}

inline void add_triangle(TriangleSoup& soup, std::uint32_t patch, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  soup.points.insert(soup.points.end(), {a, b, c});
  soup.triangles.push_back({first, first + 1, first + 2});
  soup.triangle_patch.push_back(patch);
}

/// Two triangles over the quad a b c d, split along a–c.
inline void add_quad(TriangleSoup& soup, std::uint32_t patch, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  add_triangle(soup, patch, a, b, c);
  add_triangle(soup, patch, a, c, d);
}

/// The side walls of a box between two heights, outward.
inline void add_walls(TriangleSoup& soup, std::uint32_t patch, const Vec3& low, const Vec3& high) {
  const auto p = [&](int x, int y, int z) { return Vec3{x ? high.x : low.x, y ? high.y : low.y, z ? high.z : low.z}; };
  add_quad(soup, patch, p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1));
  add_quad(soup, patch, p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1));
  add_quad(soup, patch, p(1, 1, 0), p(0, 1, 0), p(0, 1, 1), p(1, 1, 1));
  add_quad(soup, patch, p(0, 1, 0), p(0, 0, 0), p(0, 0, 1), p(0, 1, 1));
}

/// A horizontal rectangle spanning the box at height z, normal up.
inline void add_sheet(TriangleSoup& soup, std::uint32_t patch, const Vec3& low, const Vec3& high, double z) {
  add_quad(soup, patch, {low.x, low.y, z}, {high.x, low.y, z}, {high.x, high.y, z}, {low.x, high.y, z});
}

/// A closed box, one patch.
inline void add_box(TriangleSoup& soup, std::uint32_t patch, const Vec3& low, const Vec3& high) {
  add_walls(soup, patch, low, high);
  add_sheet(soup, patch, low, high, high.z);
  add_quad(soup, patch, {low.x, low.y, low.z}, {low.x, high.y, low.z}, {high.x, high.y, low.z}, {high.x, low.y, low.z});
}

inline TriangleSoup box(const Vec3& low = {0, 0, 0}, const Vec3& high = {1, 1, 1}) {
  TriangleSoup soup;
  add_box(soup, add_patch(soup, "box", Role::boundary), low, high);
  return soup;
}

/// A unit-square column of layers between the given heights: `heights.size() − 1` regions, sealed. Walls, top and
/// bottom are one boundary patch, every inner height a horizon of its own.
inline TriangleSoup layered_box(const std::vector<double>& heights) {
  TriangleSoup soup;
  const std::uint32_t boundary = add_patch(soup, "box", Role::boundary);
  const Vec3 low{0, 0, heights.front()}, high{1, 1, heights.back()};
  for (std::size_t i = 0; i + 1 < heights.size(); ++i)
    add_walls(soup, boundary, {0, 0, heights[i]}, {1, 1, heights[i + 1]});
  add_sheet(soup, boundary, low, high, heights.front());
  add_sheet(soup, boundary, low, high, heights.back());
  for (std::size_t i = 1; i + 1 < heights.size(); ++i)
    add_sheet(soup, add_patch(soup, "H" + std::to_string(i), Role::horizon), low, high, heights[i]);
  return soup;
}

/// A box with a smaller box floating inside: two regions, one of them a shell with a cavity.
inline TriangleSoup nested_boxes() {
  TriangleSoup soup = box({0, 0, 0}, {3, 3, 3});
  add_box(soup, add_patch(soup, "inner", Role::intrusion), {1, 1, 1}, {2, 2, 2});
  return soup;
}

/// A box with a free rectangle inside that touches nothing.
inline TriangleSoup box_with_floating_fault() {
  TriangleSoup soup = box({0, 0, 0}, {4, 4, 4});
  add_quad(soup, add_patch(soup, "F1", Role::fault), {1, 2, 1}, {3, 2, 1}, {3, 2, 3}, {1, 2, 3});
  return soup;
}

}  // namespace strataflow::support
