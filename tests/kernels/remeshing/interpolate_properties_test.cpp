#include "kernels/remeshing/interpolate_properties.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strataflow {
namespace {

/// Two triangles of a square; `depth` is linear, the second number of `pair` is missing at one corner.
StructuralModel square() {
  StructuralModel model;
  model.points = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
  model.triangles = {{0, 1, 2}, {0, 2, 3}};
  model.properties = {{"depth", "m", 1, {1, 5, 9, 5}}, {"pair", "", 2, {0, 7, 4, 7, 4, NAN, 0, 7}}};
  return model;
}

TEST(InterpolateProperties, are_linear_on_the_nearest_triangle) {
  const std::vector<Vec3> points{{1, 2, 0}, {3, 0.5, 0.25}, {4, 4, 0}, {9, 0, 0}};
  const std::vector<PointProperty> properties = interpolate_properties(square(), points);
  ASSERT_EQ(properties.size(), 2u);
  EXPECT_EQ(properties[0].unit, "m");
  const std::vector<double> depth{4, 4.5, 9, 5};  // 1 + x + y; beyond the square that of its corner
  ASSERT_EQ(properties[0].values.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(properties[0].values[i], depth[i], 1e-12) << i;
  ASSERT_EQ(properties[1].values.size(), 8u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(properties[1].values[2 * i], std::min(points[i].x, 4.0), 1e-12);
}

TEST(InterpolateProperties, leave_corners_without_data_out) {
  const std::vector<PointProperty> properties =
      interpolate_properties(square(), std::vector<Vec3>{{3, 1, 0}, {4, 4, 0}});
  EXPECT_NEAR(properties[1].values[1], 7, 1e-12);
  EXPECT_TRUE(std::isnan(properties[1].values[3])) << "the corner itself has no data";
}

TEST(InterpolateProperties, of_a_model_without_any_are_none) {
  StructuralModel model = square();
  model.properties.clear();
  EXPECT_TRUE(interpolate_properties(model, model.points).empty());
}

}  // namespace
}  // namespace strataflow
