#include "kernels/single_space/cutting_surface.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

TEST(CuttingSurface, finds_where_a_segment_passes_through_even_at_an_inner_edge_or_vertex) {
  // Four triangles around (0,0,0) in the plane x = 0.
  const std::vector<Vec3> points{{0, 0, 0}, {0, -1, -1}, {0, 1, -1}, {0, 1, 1}, {0, -1, 1}};
  const CuttingSurface surface(points, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
  for (const Vec3& at : {Vec3{0, 0, 0}, Vec3{0, 0.5, 0.5}, Vec3{0, 0.2, -0.7}}) {
    const auto crossing = surface.cross_segment(at + Vec3{-1, 0, 0}, at + Vec3{3, 0, 0});
    ASSERT_TRUE(crossing);
    EXPECT_EQ(crossing->point, at);
    EXPECT_DOUBLE_EQ(crossing->share, 0.25);
    EXPECT_TRUE(crossing->is_single);
    EXPECT_EQ(std::abs(surface.normal(crossing->triangle).x), 1);
  }
  EXPECT_FALSE(surface.cross_segment({-1, 3, 0}, {1, 3, 0})) << "beside it";
  EXPECT_FALSE(surface.cross_segment({1, 0, 0}, {2, 0, 0})) << "on one side";
  EXPECT_FALSE(surface.cross_segment({0, 0.1, 0}, {0, 0.5, 0})) << "within it";
}

TEST(CuttingSurface, tells_when_a_segment_passes_twice) {
  const std::vector<Vec3> points{{0, -5, -5}, {0, 5, -5}, {0, 0, 9}, {1, -5, -5}, {1, 5, -5}, {1, 0, 9}};
  const CuttingSurface surface(points, {{0, 1, 2}, {3, 4, 5}});
  const auto crossing = surface.cross_segment({-1, 0, 0}, {3, 0, 0});
  ASSERT_TRUE(crossing);
  EXPECT_FALSE(crossing->is_single);
  EXPECT_DOUBLE_EQ(crossing->share, 0.25);
}

}  // namespace
}  // namespace strataflow
