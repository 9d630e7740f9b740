#include "kernels/quads/field/smooth_frames.h"

#include <gtest/gtest.h>

#include <numbers>

#include "feature_shapes.h"
#include "kernels/quads/field/corner_quads.h"
#include "kernels/quads/field/cross_field.h"
#include "kernels/quads/field/straighten_angles.h"

namespace strataflow {
namespace {

constexpr double pi = std::numbers::pi;

TEST(SmoothFrames, are_constant_and_oblique_in_a_parallelogram_that_may_be_oblique) {
  const double angle = 1.1;
  const FeatureMesh mesh = support::sided_grid(
      8, 8, [&](double x, double y) { return Vec3{x + y * std::cos(angle), y * std::sin(angle), 0}; });
  const auto layout = build_feature_layout(mesh);
  const auto quads = choose_corner_quads(mesh, *layout);
  const auto opened = *straighten_angles(mesh, *layout, quads);
  const auto alpha = *smooth_cross_field(mesh, *layout, opened);
  std::vector<std::array<double, 2>> crosses;
  for (const double a : alpha) crosses.push_back({a, a + pi / 2});
  FieldTopology topology = match_frames(*layout, opened, crosses);
  ASSERT_TRUE(settle_singularities(mesh, *layout, quads, 3, topology));
  const auto frames = smooth_frames(mesh, *layout, opened, alpha, topology, 0);
  ASSERT_TRUE(frames);
  for (const auto& [a, b] : *frames) EXPECT_NEAR(std::sin(b - a), std::sin(angle), 1e-6);
  // Right angles drawn towards make it less oblique away from the sides, not beside them.
  const auto drawn = smooth_frames(mesh, *layout, opened, alpha, topology, 1);
  double least = 1, most = 0;
  for (const auto& [a, b] : *drawn) {
    least = std::min(least, std::sin(b - a));
    most = std::max(most, std::sin(b - a));
  }
  EXPECT_GT(most, std::sin(angle) + 0.02);
}

}  // namespace
}  // namespace strataflow
