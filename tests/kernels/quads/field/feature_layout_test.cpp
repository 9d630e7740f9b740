#include "kernels/quads/field/feature_layout.h"

#include <gtest/gtest.h>

#include <numbers>

#include "feature_shapes.h"

namespace strataflow {
namespace {

TEST(FeatureLayout, cuts_the_surroundings_of_points_at_features) {
  const FeatureMesh mesh = support::square_with_fault(8);
  const auto layout = build_feature_layout(mesh);
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->compartment_count, 1u);  // the fault dies out on both sides
  const std::uint32_t tip = 4 * 9 + 2, middle = tip + 1;
  EXPECT_EQ(layout->nodes_of(tip).size(), 1u);
  EXPECT_EQ(layout->node_kind[layout->nodes_of(tip)[0]], NodeKind::sector);
  ASSERT_EQ(layout->nodes_of(middle).size(), 2u);
  for (const std::uint32_t node : layout->nodes_of(middle)) {
    double angle = 0;
    for (const std::uint32_t c : layout->corners_of(node)) angle += layout->angle[c];
    EXPECT_NEAR(angle, std::numbers::pi, 1e-12);
  }
}

TEST(FeatureLayout, separates_compartments_and_knows_free_boundaries) {
  FeatureMesh mesh = support::bare_grid(4, 4, [](double x, double y) { return Vec3{x, y, 0}; });
  support::add_feature(mesh, "through", support::grid_path(10, 14, 1));
  const auto layout = build_feature_layout(mesh);
  ASSERT_TRUE(layout);
  EXPECT_EQ(layout->compartment_count, 2u);
  ASSERT_EQ(layout->nodes_of(10).size(), 2u);
  EXPECT_EQ(layout->node_kind[layout->nodes_of(10)[0]], NodeKind::open);
  EXPECT_EQ(layout->node_kind[layout->nodes_of(11)[0]], NodeKind::sector);
  EXPECT_EQ(layout->node_kind[layout->nodes_of(6)[0]], NodeKind::inside);
}

TEST(FeatureLayout, names_what_is_wrong_with_a_mesh) {
  FeatureMesh mesh = support::square(2);
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  EXPECT_NE(build_feature_layout(mesh).failure().what.find("opposite ways"), std::string::npos);
  mesh = support::square(2);
  mesh.edges[0].b = 8;
  EXPECT_NE(build_feature_layout(mesh).failure().what.find("no edge of the mesh"), std::string::npos);
  mesh = support::square(2);
  mesh.points[4] = mesh.points[3];
  EXPECT_NE(build_feature_layout(mesh).failure().what.find("no area"), std::string::npos);
  mesh = support::square(2);
  mesh.points[4].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(build_feature_layout(mesh).failure().what.find("not finite"), std::string::npos);
  mesh = support::bare_grid(2, 2, [](double x, double y) { return Vec3{x, y, 0}; },
                            [](std::uint32_t i, std::uint32_t j) { return i == j; });
  EXPECT_NE(build_feature_layout(mesh).failure().what.find("two sheets touch"), std::string::npos);
  mesh.triangles = {{0, 1, 99}};
  EXPECT_EQ(build_feature_layout(mesh).failure().code, FailureCode::invalid_input);
}

}  // namespace
}  // namespace strataflow
