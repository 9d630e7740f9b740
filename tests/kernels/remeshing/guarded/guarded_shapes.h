#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <string>

#include "kernels/intersection/find_intersections.h"
#include "kernels/topology/building/build_structural_model.h"
#include "model/structural_model.h"
#include "support/shapes.h"

namespace strataflow::support {

/// n × n quads over the unit square, halved.
inline void add_grid(TriangleSoup& soup, const std::string& name, int n,
                     const std::function<Vec3(double, double)>& place, Role role = Role::horizon) {
  const std::uint32_t patch = add_patch(soup, name, role);
  const auto at = [&](int i, int j) { return place(double(i) / n, double(j) / n); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) add_quad(soup, patch, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
}

/// A horizontal sheet, 8 × 8 m, and a vertical one that stands on all of its middle: one contact of three surfaces.
inline TriangleSoup standing_sheet() {
  TriangleSoup soup;
  add_grid(soup, "lying", 8, [](double u, double v) { return Vec3{8 * u, 8 * v, 0}; });
  add_grid(soup, "standing", 8, [](double u, double v) { return Vec3{8 * u, 4, 8 * v}; });
  return soup;
}

/// The same, but the standing sheet ends inside the lying one at both ends: free borders, two corners inside.
inline TriangleSoup dying_fault() {
  TriangleSoup soup;
  add_grid(soup, "lying", 16, [](double u, double v) { return Vec3{16 * u, 16 * v, 0.4 * std::sin(16 * u)}; });
  add_grid(
      soup, "standing", 8,
      [](double u, double v) {
        return Vec3{4 + 8 * u, 8, v == 0 ? 0.4 * std::sin(4 + 8 * u) : 6 * v};
      },
      Role::fault);
  return soup;
}

/// A box of 10 × 10 × 9 m with two wavy horizons, conforming: three regions.
inline TriangleSoup layered_box(int n) {
  const auto level = [](int k, double u, double v) {
    const double wave = k == 1 || k == 2 ? 0.6 * std::sin(5 * u + k) * std::cos(4 * v) : 0;
    return Vec3{10 * u, 10 * v, 3.0 * k + wave};
  };
  TriangleSoup soup;
  for (const auto& [name, k] : {std::pair{"Bottom", 0}, {"H1", 1}, {"H2", 2}, {"Top", 3}})
    add_grid(
        soup, name, n, [&](double u, double v) { return level(k, u, v); },
        k == 0 || k == 3 ? Role::boundary : Role::horizon);
  for (int side = 0; side < 4; ++side) {
    const std::uint32_t patch = add_patch(soup, "side " + std::to_string(side), Role::boundary);
    const auto at = [&](int k, double s) {
      return side == 0 ? level(k, s, 0) : side == 1 ? level(k, s, 1) : side == 2 ? level(k, 0, s) : level(k, 1, s);
    };
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < n; ++i)
        add_quad(soup, patch, at(k, double(i) / n), at(k, double(i + 1) / n), at(k + 1, double(i + 1) / n),
                 at(k + 1, double(i) / n));
  }
  return soup;
}

inline StructuralModel built(const TriangleSoup& soup) {
  const Result<BuiltModel> model = build_structural_model(soup);
  EXPECT_TRUE(model);
  return model->model;
}

/// How many lines have how many surfaces around them.
inline std::map<std::size_t, int> valences(const StructuralModel& model) {
  std::map<std::size_t, int> count;
  for (const Line& line : model.lines) ++count[line.surfaces.size()];
  return count;
}

/// The same corners in the same places, and as many lines, surfaces and regions; nothing meets improperly.
inline void expect_same_structure(const StructuralModel& before, const StructuralModel& after) {
  EXPECT_EQ(after.surfaces.size(), before.surfaces.size());
  EXPECT_EQ(after.regions.size(), before.regions.size());
  EXPECT_EQ(valences(after), valences(before));
  std::vector<Vec3> was, is;
  for (const Corner& c : before.corners) was.push_back(before.points[c.vertex]);
  for (const Corner& c : after.corners) is.push_back(after.points[c.vertex]);
  std::sort(was.begin(), was.end(), lexicographically_less);
  std::sort(is.begin(), is.end(), lexicographically_less);
  EXPECT_EQ(is, was);
  EXPECT_TRUE(find_intersections(after.points, after.triangles).empty());
}

}  // namespace strataflow::support
