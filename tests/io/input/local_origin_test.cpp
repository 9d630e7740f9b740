#include "io/input/local_origin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/seed.h"

namespace strataflow {
namespace {

/// Shifts the points and says whether adding the origin gives back the very same doubles.
bool survives(const std::vector<Vec3>& points, Vec3& origin) {
  InputData data;
  data.surfaces.points = points;
  data.volume.points = points;
  data.lines.push_back({"line", Role::curve, points, false});
  data.point_sets.push_back({"set", Role::points, points, {}});
  shift_to_local_origin(data);
  origin = data.surfaces.local_origin;
  bool is_same = data.volume.local_origin == origin;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const Vec3& shifted :
         {data.surfaces.points[i], data.volume.points[i], data.lines[0].points[i], data.point_sets[0].points[i]})
      is_same = is_same && shifted + origin == points[i];
  return is_same;
}

std::vector<Vec3> random_points(std::uint64_t seed, const Vec3& low, const Vec3& extent, bool as_float) {
  RandomStream random(seed);
  std::vector<Vec3> points(200);
  for (Vec3& p : points)
    for (int axis = 0; axis < 3; ++axis) {
      p[axis] = low[axis] + extent[axis] * random.unit();
      if (as_float) p[axis] = static_cast<float>(p[axis]);
    }
  return points;
}

TEST(LocalOrigin, utm_coordinates_shift_near_zero_and_come_back_bit_for_bit) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    RandomStream random(seed_for(seed, "size"));
    const double size_m = std::exp2(1 + 14 * random.unit());
    const std::vector<Vec3> points =
        random_points(seed, {461000.123 + size_m, 5937398.964, -2000}, {size_m, 2 * size_m, 4000}, seed % 2 == 1);
    Vec3 origin;
    ASSERT_TRUE(survives(points, origin)) << "seed " << seed;
    EXPECT_LE(std::abs(origin.x - points[0].x), 2 * size_m) << "seed " << seed;
    EXPECT_LE(std::abs(origin.y - points[0].y), 4 * size_m) << "seed " << seed;
    EXPECT_EQ(origin.z, 0) << "z crosses zero: nothing to gain";
  }
}

TEST(LocalOrigin, values_that_cross_zero_or_mix_sizes_come_back_bit_for_bit) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    std::vector<Vec3> points = random_points(seed, {-10, 1e-9, 3e5}, {30, 9e6, 9e5}, seed % 3 == 0);
    points.push_back({-0.0, 0x1p-1000, 1e15});
    Vec3 origin;
    EXPECT_TRUE(survives(points, origin)) << "seed " << seed;
  }
}

TEST(LocalOrigin, a_flat_surface_far_away_and_extreme_values_come_back) {
  Vec3 origin;
  EXPECT_TRUE(survives({{0, 0, -5000.25}, {1, 0, -5000.25}, {0, 1, -5000.25}}, origin));
  EXPECT_NEAR(origin.z, -5000.25, 1);
  EXPECT_TRUE(survives({{1.7e308, -1.7e308, 1}, {-1.7e308, -1.6e308, 1}}, origin));
  EXPECT_TRUE(survives({}, origin));
  EXPECT_EQ(origin, Vec3{});
}

TEST(LocalOrigin, data_that_was_shifted_is_left_alone) {
  InputData data;
  data.surfaces.points = {{5e6, 5e6, 5e6}, {5e6 + 1, 5e6 + 1, 5e6 + 1}};
  shift_to_local_origin(data);
  const Vec3 origin = data.surfaces.local_origin;
  const std::vector<Vec3> points = data.surfaces.points;
  shift_to_local_origin(data);
  EXPECT_EQ(data.surfaces.local_origin, origin);
  EXPECT_EQ(data.surfaces.points, points);
}

}  // namespace
}  // namespace strataflow
