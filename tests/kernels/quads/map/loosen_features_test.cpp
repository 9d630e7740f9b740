#include "kernels/quads/map/loosen_features.h"

#include <gtest/gtest.h>

#include <tuple>

#include "../field/feature_shapes.h"
#include "kernels/quads/field/separate_features.h"
#include "kernels/quads/map/seamless_map.h"

namespace strataflow {
namespace {

/// A square of 8 × 8 cells with two curves inside: feature 4 in row 2, feature 5 in row 5, which has a part in common
/// with feature 6.
FeatureMesh two_curves() {
  FeatureMesh mesh = support::square(8);
  support::add_feature(mesh, "low", support::grid_path(2 * 9 + 2, 2 * 9 + 6, 1));
  support::add_feature(mesh, "high", support::grid_path(5 * 9 + 2, 5 * 9 + 6, 1));
  support::add_feature(mesh, "part of high", support::grid_path(5 * 9 + 4, 5 * 9 + 6, 1));
  support::add_corners(mesh, {20, 24, 47, 49, 51});
  return mesh;
}

TEST(LoosenFeatures, edges_go_but_corners_and_what_others_hold_stay) {
  const FeatureMesh mesh = two_curves();
  const FeatureMesh rest = without_features(mesh, {4, 5});
  EXPECT_EQ(rest.edges.size(), 32 + 2u) << "the sides, and two edges of the other feature on the same curve";
  EXPECT_EQ(rest.corners, mesh.corners);
  EXPECT_EQ(rest.features.size(), mesh.features.size());
  const std::vector<FeatureEdge> taken = edges_of_features(mesh, {4, 5});
  EXPECT_EQ(taken.size(), 8u);
  EXPECT_EQ(rest.edges.size() + taken.size(), mesh.edges.size());
}

TEST(LoosenFeatures, the_curve_nearest_to_a_fold_is_the_one_to_leave_out_and_never_the_outline) {
  const FeatureMesh mesh = two_curves();
  const auto triangle_at = [](std::uint32_t i, std::uint32_t j) { return 2 * (j * 8 + i); };
  EXPECT_EQ(loosest_feature(mesh, {triangle_at(4, 1)}), 4u);
  EXPECT_EQ(loosest_feature(mesh, {triangle_at(3, 7)}), 5u) << "the outline is nearer";
  EXPECT_EQ(loosest_feature(mesh, {triangle_at(4, 1), triangle_at(4, 5), triangle_at(5, 4), triangle_at(3, 5)}), 5u)
      << "it has more edges there";
  EXPECT_EQ(loosest_feature(mesh, {}), std::nullopt);
  EXPECT_EQ(loosest_feature(support::square(4), {0}), std::nullopt);
}

TEST(LoosenFeatures, axes_go_to_curves_that_run_along_them_nearly) {
  const FeatureMesh mesh = *separate_features(two_curves());
  const auto found = compute_seamless_map(without_features(mesh, {4, 5, 6}));
  ASSERT_TRUE(found) << describe(found.failure());
  CornerMap map = found->map.map;
  EXPECT_EQ(take_near_axes(mesh, {4}, map), (std::vector<std::uint32_t>{4}));
  for (std::uint32_t h = 0; h < map.axes.size(); ++h) {
    const std::uint32_t a = mesh.triangles[h / 3][h % 3], b = mesh.triangles[h / 3][(h + 1) % 3];
    const bool is_low = std::any_of(mesh.edges.begin(), mesh.edges.end(), [&](const FeatureEdge& e) {
      return e.feature == 4 && e.a == std::min(a, b) && e.b == std::max(a, b);
    });
    if (!is_low) {
      EXPECT_EQ(map.axes[h], found->map.map.axes[h]);
      continue;
    }
    const auto along = map.at(h % 3 == 2 ? h - 2 : h + 1) - map.at(h);
    EXPECT_EQ(map.axes[h], std::abs(along.real()) > std::abs(along.imag()) ? MapAxis::real : MapAxis::imaginary);
  }
  // Turned by 40 degrees nothing is near an axis any more.
  CornerMap turned = found->map.map;
  for (auto& z : turned.uv) {
    const std::complex<double> w = std::complex<double>(z[0], z[1]) * std::polar(1.0, 0.7);
    z = {w.real(), w.imag()};
  }
  const std::vector<MapAxis> before = turned.axes;
  EXPECT_TRUE(take_near_axes(mesh, {4, 5}, turned).empty());
  EXPECT_EQ(turned.axes, before);
}

}  // namespace
}  // namespace strataflow
