#include "kernels/topology/building/radial_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/seed.h"
#include "kernels/adapters/cgal/exact_predicates.h"
#include "kernels/topology/building/build_regions.h"

namespace strataflow {
namespace {

/// Blades around the z axis: points 0 and 1 on the axis, one apex per angle; every other triangle turned over.
struct Pinwheel {
  std::vector<Vec3> points{{0, 0, 0}, {0, 0, 1}};
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> half_edges;
  void add(const Vec3& apex) {
    const auto v = static_cast<std::uint32_t>(points.size());
    points.push_back(apex);
    const auto t = static_cast<std::uint32_t>(triangles.size());
    triangles.push_back(t % 2 ? Triangle{1, 0, v} : Triangle{0, 1, v});
    half_edges.push_back(3 * t);
  }
};

TEST(RadialOrder, goes_round_by_angle_from_the_first) {
  RandomStream random(11);
  for (int round = 0; round < 200; ++round) {
    Pinwheel wheel;
    std::vector<double> angles;
    const std::size_t blades = 2 + random.below(7);
    for (std::size_t i = 0; i < blades; ++i) {
      const double angle = 2 * M_PI * random.unit();
      angles.push_back(angle);
      wheel.add({std::cos(angle), std::sin(angle), random.unit()});
    }
    const RadialOrder order = radial_order(wheel.points, wheel.triangles, wheel.half_edges);
    ASSERT_FALSE(order.is_ambiguous);
    std::vector<std::uint32_t> expected = wheel.half_edges;
    const auto turn = [&](std::uint32_t h) { return std::fmod(angles[h / 3] - angles[0] + 4 * M_PI, 2 * M_PI); };
    std::sort(expected.begin() + 1, expected.end(),
              [&](std::uint32_t a, std::uint32_t b) { return turn(a) < turn(b); });
    EXPECT_EQ(order.half_edges, expected);
  }
}

TEST(RadialOrder, tells_angles_apart_that_floating_point_cannot) {
  Pinwheel wheel;
  wheel.add({1, 0, 0});
  wheel.add({1e15, 1, 0});
  wheel.add({1e15, std::nextafter(1.0, 0.0), 0});
  const RadialOrder order = radial_order(wheel.points, wheel.triangles, wheel.half_edges);
  ASSERT_FALSE(order.is_ambiguous);
  EXPECT_EQ(order.half_edges, (std::vector<std::uint32_t>{0, 6, 3}));
}

TEST(RadialOrder, opposite_blades_are_told_from_coinciding_ones) {
  Pinwheel opposite;
  opposite.add({1, 0, 0});
  opposite.add({-1, 0, 0});
  EXPECT_FALSE(radial_order(opposite.points, opposite.triangles, opposite.half_edges).is_ambiguous);
  Pinwheel coinciding;
  coinciding.add({1, 0, 0});
  coinciding.add({2, 0, 0.5});
  EXPECT_TRUE(radial_order(coinciding.points, coinciding.triangles, coinciding.half_edges).is_ambiguous);
}

TEST(ExactPredicates, signs_are_right_where_rounding_decides_nothing) {
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0};
  EXPECT_EQ(orientation_3d(a, b, c, {0, 0, 1e-300}), 1);
  EXPECT_EQ(orientation_3d(a, b, c, {0.3, 0.3, -1e-300}), -1);
  EXPECT_EQ(orientation_3d(a, b, c, {1e300, -1e300, 0}), 0);
  // On the diagonal plane x = y up to the last bit.
  const double x = 0.1;
  EXPECT_EQ(orientation_3d({0, 0, 0}, {1, 1, 0}, {0, 0, 1}, {x, x, 0.7}), 0);
  EXPECT_NE(orientation_3d({0, 0, 0}, {1, 1, 0}, {0, 0, 1}, {x, std::nextafter(x, 1.0), 0.7}), 0);
  EXPECT_EQ(orientation_2d(0, 0, 3, 3, std::nextafter(1.0, 2.0), 1), -1);
  EXPECT_EQ(projection_axis({0, 0, 0}, {1, 1, 1}, {2, 2, 2}), -1);
}

}  // namespace
}  // namespace strataflow
