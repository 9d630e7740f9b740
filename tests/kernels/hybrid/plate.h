#pragma once
#include <functional>
#include <vector>

#include "kernels/topology/building/build_structural_model.h"
#include "model/structural_model.h"
#include "support/shapes.h"

namespace strataflow::support {

/// A closed plate over `count` × `count` unit squares of the ground, each cut in two, with the same triangles below
/// (height 0) and above, and walls of two triangles per edge. Points one above the other share a site. Where the roof
/// comes down to 0 the plate ends.
struct Plate {
  StructuralModel model;
  std::vector<std::uint32_t> sites;  ///< per point
};

inline Plate plate(int count, const std::function<double(double x, double y)>& roof) {
  TriangleSoup soup;
  const std::uint32_t patch = add_patch(soup, "plate", Role::boundary);
  const auto below = [](int i, int j) { return Vec3{double(i), double(j), 0}; };
  const auto above = [&](int i, int j) { return Vec3{double(i), double(j), roof(i, j)}; };
  const auto triangle = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    if (a != b && b != c && c != a) add_triangle(soup, patch, a, b, c);
  };
  const auto wall = [&](int i, int j, int k, int l) {  // the outside is on the right, walking from (i, j) to (k, l)
    triangle(below(i, j), below(k, l), above(k, l));
    triangle(below(i, j), above(k, l), above(i, j));
  };
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; ++j) {
      if (roof(i, j) == 0 && roof(i + 1, j) == 0 && roof(i, j + 1) == 0 && roof(i + 1, j + 1) == 0) continue;
      triangle(above(i, j), above(i + 1, j), above(i + 1, j + 1));
      triangle(above(i, j), above(i + 1, j + 1), above(i, j + 1));
      triangle(below(i, j), below(i + 1, j + 1), below(i + 1, j));
      triangle(below(i, j), below(i, j + 1), below(i + 1, j + 1));
    }
  for (int i = 0; i < count; ++i) {
    wall(i, 0, i + 1, 0);
    wall(count, i, count, i + 1);
    wall(count - i, count, count - i - 1, count);
    wall(0, count - i, 0, count - i - 1);
  }
  Plate made;
  made.model = build_structural_model(soup)->model;
  for (const Vec3& p : made.model.points) made.sites.push_back(static_cast<std::uint32_t>(p.x * (count + 1) + p.y));
  return made;
}

}  // namespace strataflow::support
