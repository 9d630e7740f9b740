#include "kernels/quality/nearest_triangle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/seed.h"
#include "kernels/quality/curved_meshes.h"

namespace strataflow {
namespace {

TEST(NearestTriangle, knows_the_seven_places_of_a_triangle) {
  const std::vector<Vec3> points{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};
  const std::vector<Triangle> triangles{{0, 1, 2}};
  const NearestTriangle search({points, triangles});
  EXPECT_DOUBLE_EQ(search.squared_m2({0.5, 0.5, 3}, 0), 9);      // inside
  EXPECT_DOUBLE_EQ(search.squared_m2({-1, -1, 1}, 0), 3);        // first corner
  EXPECT_DOUBLE_EQ(search.squared_m2({3, -1, 0}, 0), 2);         // second
  EXPECT_DOUBLE_EQ(search.squared_m2({-1, 4, 2}, 0), 1 + 4 + 4); // third
  EXPECT_DOUBLE_EQ(search.squared_m2({1, -2, 1}, 0), 5);         // first edge
  EXPECT_DOUBLE_EQ(search.squared_m2({2, 2, 0}, 0), 2);          // second edge
  EXPECT_DOUBLE_EQ(search.squared_m2({-3, 1, 0}, 0), 9);         // third edge
}

TEST(NearestTriangle, finds_what_looking_at_every_triangle_finds_whatever_the_guess) {
  const Mesh mesh = sphere(1, 12);
  const NearestTriangle search({mesh.points, mesh.triangles});
  RandomStream random(5);
  for (int i = 0; i < 400; ++i) {
    const Vec3 p{4 * random.unit() - 2, 4 * random.unit() - 2, 4 * random.unit() - 2};
    NearestTriangle::Hit best{no_index, std::numeric_limits<double>::infinity()};
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      if (const double squared = search.squared_m2(p, t); squared < best.squared_m2) best = {t, squared};
    for (const std::uint32_t guess : {no_index, 0u, 100u}) {
      const NearestTriangle::Hit found = search.nearest(p, guess);
      EXPECT_EQ(found.triangle, best.triangle);
      EXPECT_EQ(found.squared_m2, best.squared_m2);
    }
  }
}

TEST(NearestTriangle, tells_whether_any_lies_within_a_distance_whatever_the_guess) {
  const Mesh mesh = sphere(1, 12);
  const NearestTriangle search({mesh.points, mesh.triangles});
  RandomStream random(6);
  std::uint32_t last = no_index;
  for (int i = 0; i < 400; ++i) {
    const Vec3 p{4 * random.unit() - 2, 4 * random.unit() - 2, 4 * random.unit() - 2};
    const double reach = random.unit(), nearest = search.nearest(p).squared_m2;
    std::uint32_t none = no_index;
    EXPECT_EQ(search.is_within(p, reach, none), nearest <= reach);
    EXPECT_EQ(search.is_within(p, reach, last), nearest <= reach);
    if (nearest <= reach) {
      EXPECT_LE(search.squared_m2(p, last), reach);
    }
    EXPECT_TRUE(search.is_within(p, nearest, none));
  }
}

TEST(NearestTriangle, an_empty_mesh_is_infinitely_far) {
  EXPECT_EQ(NearestTriangle({{}, {}}).nearest({1, 2, 3}).squared_m2, std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace strataflow
