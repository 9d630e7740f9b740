#include "kernels/quads/field/cross_field.h"

#include <gtest/gtest.h>

#include <numbers>

#include "feature_shapes.h"
#include "kernels/quads/field/straighten_angles.h"

namespace strataflow {
namespace {

TEST(CrossField, is_constant_in_a_square_turned_by_any_angle) {
  for (const double turn : {0.0, 0.3, 0.7}) {
    const FeatureMesh mesh = support::sided_grid(8, 8, [&](double x, double y) {
      return Vec3{x * std::cos(turn) - y * std::sin(turn), x * std::sin(turn) + y * std::cos(turn), 0};
    });
    const auto layout = build_feature_layout(mesh);
    const auto alpha = smooth_cross_field(mesh, *layout, layout->angle);
    ASSERT_TRUE(alpha);
    for (std::uint32_t t = 0; t < layout->triangle_count(); ++t) {
      const Vec3 edge = mesh.points[mesh.triangles[t][1]] - mesh.points[mesh.triangles[t][0]];
      const double absolute = std::atan2(edge.y, edge.x) + (*alpha)[t] - turn;
      EXPECT_NEAR(std::remainder(absolute, std::numbers::pi / 2), 0, 1e-9);
    }
  }
}

TEST(CrossField, stands_on_every_feature_edge_exactly) {
  const FeatureMesh mesh = support::disc(6);
  const auto layout = build_feature_layout(mesh);
  const auto alpha = smooth_cross_field(mesh, *layout, layout->angle);
  for (std::uint32_t h = 0; h < layout->opposite.size(); ++h)
    if (layout->is_feature[h]) {
      EXPECT_NEAR(std::remainder((*alpha)[h / 3] - half_edge_direction(layout->angle, h), std::numbers::pi / 2), 0, 1e-14);
    }
}

TEST(CrossField, needs_no_feature) {
  const FeatureMesh mesh = support::torus(16, 8);
  const auto layout = build_feature_layout(mesh);
  const auto alpha = smooth_cross_field(mesh, *layout, layout->angle);
  ASSERT_TRUE(alpha);
  for (const double a : *alpha) EXPECT_TRUE(std::isfinite(a));
}

}  // namespace
}  // namespace strataflow
