#include "kernels/topology/building/shell_containment.h"

#include <gtest/gtest.h>

#include <array>

#include "kernels/topology/building/build_structural_model.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

TEST(ShellContainment, a_ray_through_a_shared_edge_crosses_one_of_the_two_triangles) {
  const Vec3 a{0, 0, 1}, b{1, 1, 1}, c{1, 0, 1}, d{0, 1, 1}, below{.5, .5, 0};
  const int crossings = (meeting_of_upward_ray(below, a, c, b) == RayMeeting::crosses) +
                        (meeting_of_upward_ray(below, a, b, d) == RayMeeting::crosses);
  EXPECT_EQ(crossings, 1);
  EXPECT_EQ(meeting_of_upward_ray({.5, .5, 1}, a, c, b), RayMeeting::starts_on);
  EXPECT_EQ(meeting_of_upward_ray({.6, .5, 2}, a, c, b), RayMeeting::misses);
}

TEST(ShellContainment, the_inside_of_a_triangle_is_placed_although_its_vertices_lie_on_the_shell) {
  const StructuralModel model = build_structural_model(support::box())->model;
  const std::vector<SurfaceSide> shell{{0, 1}};
  const auto place = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    return place_in_shell(model, shell, std::array{a, b, c});
  };
  const Vec3 left{0, .5, .5}, front{.5, 0, .5}, top{.5, .5, 1}, low{0, 0, 0}, far{1, 1, 1};
  for (const Vec3& v : {left, front, top, low, far}) EXPECT_EQ(place_in_shell(model, shell, Place(&v, 1)), 0);
  EXPECT_EQ(place(left, front, top), 1);
  EXPECT_EQ(place(top, left, front), 1);
  EXPECT_EQ(place(low, far, top), 1);                          // an edge along the cube's diagonal
  EXPECT_EQ(place({0, .5, .5}, {0, .2, .5}, {.5, .5, 0}), 1);  // an edge in a wall, the third vertex on the bottom
  EXPECT_EQ(place({0, .5, .5}, {0, .2, .5}, {0, .5, .9}), 0);  // in a wall
  EXPECT_EQ(place({0, 0, 1}, {1, 0, 1}, {.5, -1, 1}), -1);
  EXPECT_EQ(place({0, .5, .5}, {0, .2, .5}, {-1, .5, .5}), -1);
}

TEST(ShellContainment, a_surface_with_both_sides_is_no_part_of_the_shell) {
  const std::vector<SurfaceSide> sides{{0, 1}, {1, 0}, {1, 1}, {2, 0}}, lone{{0, 1}, {2, 0}};
  EXPECT_EQ(closed_shell_of(sides), lone);
}

}  // namespace
}  // namespace strataflow
