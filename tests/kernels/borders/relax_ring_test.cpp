#include "kernels/borders/relax_ring.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strataflow {
namespace {

std::vector<Triangle> fan(std::uint32_t n) {
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < n; ++i) triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
  return triangles;
}

TEST(RelaxRing, puts_a_node_at_the_centroid_of_its_convex_star_in_one_step) {  // euler1999 §4.2 test 7
  // A trapezium of area 12 whose centroid is known: (2, 8/6·…) by the two triangles of its own.
  const std::vector<Vec3> rim{{0, 0, 0}, {6, 0, 0}, {4, 3, 0}, {2, 3, 0}};
  const Vec3 centroid{3, 3.0 * (6 + 2 * 2) / (3 * (6 + 2)), 0};
  for (const Vec3& start : {Vec3{1, 0.5, 0}, Vec3{4, 2.5, 0}, Vec3{3, 1, 0}}) {
    std::vector<Vec3> points{start};
    points.insert(points.end(), rim.begin(), rim.end());
    EXPECT_EQ(relax_ring(points, fan(4), {0}, 45), std::vector<std::uint32_t>{0});
    EXPECT_NEAR(points[0].x, centroid.x, 1e-14);
    EXPECT_NEAR(points[0].y, centroid.y, 1e-14);
    const Vec3 once = points[0];
    relax_ring(points, fan(4), {0}, 45);
    EXPECT_NEAR(length(points[0] - once), 0, 1e-15);
  }
}

TEST(RelaxRing, gives_up_a_move_that_turns_a_triangle_over) {
  // A star whose centroid lies outside it: a thin boomerang.
  std::vector<Vec3> points{{0, 0.05, 0}, {-4, 4, 0}, {0, 0, 0}, {4, 4, 0}, {0, 0.2, 0}};
  const std::vector<Vec3> before = points;
  EXPECT_TRUE(relax_ring(points, fan(4), {0}, 45).empty());
  EXPECT_EQ(points, before);
}

TEST(RelaxRing, leaves_a_node_on_a_crease) {
  std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-2, 0, 0}, {0, 0, -1}};
  EXPECT_TRUE(relax_ring(points, fan(4), {0}, 30).empty());
}

TEST(RelaxRing, takes_all_targets_from_the_old_positions) {
  // Two free nodes side by side on a symmetric patch move as mirror images.
  std::vector<Vec3> points{{1, 1, 0}, {2, 1, 0}, {0, 0, 0},     {1.5, -0.5, 0},
                           {3, 0, 0}, {3, 2, 0}, {1.5, 2.5, 0}, {0, 2, 0}};
  const std::vector<Triangle> triangles{{0, 2, 3}, {0, 3, 1}, {1, 3, 4}, {1, 4, 5},
                                        {1, 5, 6}, {1, 6, 0}, {0, 6, 7}, {0, 7, 2}};
  EXPECT_EQ(relax_ring(points, triangles, {0, 1}, 45).size(), 2u);
  EXPECT_NEAR(points[0].x + points[1].x, 3, 1e-15);
  EXPECT_NEAR(points[0].y, points[1].y, 1e-15);
}

}  // namespace
}  // namespace strataflow
