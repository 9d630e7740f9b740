#include "kernels/quads/map/seamless_map.h"

#include <gtest/gtest.h>

#include "../field/feature_shapes.h"
#include "kernels/quads/field/separate_features.h"

namespace strataflow {
namespace {

TEST(SeamlessMap, follows_the_first_field_that_has_a_valid_map) {
  const FeatureMesh mesh = *separate_features(support::disc(8));
  const auto result = compute_seamless_map(mesh);
  ASSERT_TRUE(result) << describe(result.failure());
  EXPECT_TRUE(result->retries.empty());
  EXPECT_EQ(result->map.map.turns, result->field.field.turns);
  EXPECT_EQ(measure_map(mesh, result->map.map)->flipped, 0);
}

TEST(SeamlessMap, tells_the_first_reason_when_no_field_has_one) {
  // One point inside a circle would have to be four singular points at once.
  FeatureMesh mesh;
  mesh.points.push_back({0, 0, 0});
  std::vector<std::uint32_t> circle;
  for (std::uint32_t i = 0; i < 12; ++i) {
    mesh.points.push_back({std::cos(i * std::numbers::pi / 6), std::sin(i * std::numbers::pi / 6), 0});
    mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % 12});
    circle.push_back(1 + i);
  }
  circle.push_back(1);
  support::add_feature(mesh, "circle", circle);
  mesh.edge_length_m = 1;
  const auto result = compute_seamless_map(mesh);
  ASSERT_FALSE(result);
  EXPECT_FALSE(result.failure().what.empty());
}

TEST(SeamlessMap, refuses_a_mesh_that_is_none_at_once) {
  FeatureMesh mesh = support::square(2);
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  EXPECT_EQ(compute_seamless_map(mesh).failure().code, FailureCode::invalid_input);
}

}  // namespace
}  // namespace strataflow
