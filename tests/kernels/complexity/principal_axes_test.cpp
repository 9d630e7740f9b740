#include "kernels/complexity/principal_axes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strataflow {
namespace {

TEST(PrincipalAxes, of_a_known_matrix) {
  const PrincipalAxes found = principal_axes({2, 2, 5, 1, 0, 0});  // 3 along (1, 1, 0), 1 along (1, −1, 0)
  EXPECT_NEAR(found.values[0], 5, 1e-14);
  EXPECT_NEAR(found.values[1], 3, 1e-14);
  EXPECT_NEAR(found.values[2], 1, 1e-14);
  EXPECT_NEAR(std::abs(found.axes[1].x * found.axes[1].y), 0.5, 1e-14);
  EXPECT_NEAR(std::abs(found.axes[0].z), 1, 1e-14);
}

TEST(MassMoments, of_a_rectangle_are_the_textbook_ones) {  // 6 × 2 in the plane z = x, centre (0, 0, 0)
  const double c = std::sqrt(0.5);
  const Vec3 p{-3 * c, -1, -3 * c}, q{3 * c, -1, 3 * c}, r{3 * c, 1, 3 * c}, s{-3 * c, 1, -3 * c};
  MassMoments moments;
  moments.take_triangle(p, q, r);
  moments.take_triangle(p, r, s);
  EXPECT_NEAR(moments.mass(), 12, 1e-13);
  EXPECT_NEAR(length(moments.centre()), 0, 1e-14);
  const PrincipalAxes axes = moments.axes();
  EXPECT_NEAR(axes.values[0], 12 * 36 / 12.0, 1e-12);
  EXPECT_NEAR(axes.values[1], 12 * 4 / 12.0, 1e-12);
  EXPECT_NEAR(axes.values[2], 0, 1e-12);
  EXPECT_NEAR(std::abs(dot(axes.axes[2], {c, 0, -c})), 1, 1e-14);
}

TEST(MassMoments, of_a_segment_are_the_textbook_ones) {
  MassMoments moments;
  moments.take_segment({1, 0, 0}, {1, 0, 6});
  EXPECT_NEAR(moments.mass(), 6, 1e-15);
  EXPECT_NEAR(moments.centre().z, 3, 1e-15);
  EXPECT_NEAR(moments.axes().values[0], 18, 1e-12);
  EXPECT_NEAR(std::abs(moments.axes().axes[0].z), 1, 1e-14);
}

}  // namespace
}  // namespace strataflow
