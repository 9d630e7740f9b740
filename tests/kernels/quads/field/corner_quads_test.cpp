#include "kernels/quads/field/corner_quads.h"

#include <gtest/gtest.h>

#include <numbers>

#include "feature_shapes.h"

namespace strataflow {
namespace {

/// Rays of length 1 from the origin at the given angles (degrees), each a feature, inside a polygon without features.
/// Returns the quads of the sectors, counter-clockwise from the first ray.
std::vector<int> quads_between(std::vector<double> rays_deg) {
  FeatureMesh mesh;
  mesh.points.push_back({0, 0, 0});
  std::vector<double> angles;
  for (std::size_t i = 0; i < rays_deg.size(); ++i) {
    const double end = i + 1 < rays_deg.size() ? rays_deg[i + 1] : rays_deg[0] + 360;
    for (int k = 0; k < 4; ++k) angles.push_back(rays_deg[i] + (end - rays_deg[i]) * k / 4);
  }
  for (const double a : angles)
    mesh.points.push_back({std::cos(a * std::numbers::pi / 180), std::sin(a * std::numbers::pi / 180), 0});
  const auto count = static_cast<std::uint32_t>(angles.size());
  for (std::uint32_t i = 0; i < count; ++i) mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % count});
  for (std::uint32_t i = 0; i < count; i += 4) support::add_feature(mesh, "ray", {0, 1 + i});
  mesh.edge_length_m = 1;
  const auto layout = build_feature_layout(mesh);
  EXPECT_TRUE(layout);
  const auto quads = choose_corner_quads(mesh, *layout);
  std::vector<int> found;
  for (std::uint32_t i = 0; i < count; i += 4) found.push_back(quads[layout->node_of[3 * i]]);
  return found;
}

TEST(CornerQuads, keep_tips_bends_and_crossings_regular) {
  EXPECT_EQ(quads_between({10}), (std::vector{4}));
  EXPECT_EQ(quads_between({0, 180}), (std::vector{2, 2}));
  EXPECT_EQ(quads_between({0, 120}), (std::vector{2, 2}));
  EXPECT_EQ(quads_between({0, 90}), (std::vector{1, 3}));
  EXPECT_EQ(quads_between({0, 90, 180, 270}), (std::vector{1, 1, 1, 1}));
  EXPECT_EQ(quads_between({0, 35, 180, 215}), (std::vector{1, 1, 1, 1}));
  EXPECT_EQ(quads_between({0, 90, 180}), (std::vector{1, 1, 2}));
  EXPECT_EQ(quads_between({0, 40, 180}), (std::vector{1, 1, 2}));
}

TEST(CornerQuads, give_acute_sectors_one_quad_and_what_is_left_to_the_wide_ones) {
  EXPECT_EQ(quads_between({0, 2, 180}), (std::vector{1, 2, 2}));
  EXPECT_EQ(quads_between({0, 2, 180, 182}), (std::vector{1, 2, 1, 2}));
  for (const int quads : quads_between({0, 10, 20, 30, 40, 50, 60})) EXPECT_GE(quads, 1);
}

TEST(CornerQuads, round_on_the_boundary) {
  const FeatureMesh mesh = support::wedge(4, 0.03);
  const auto layout = build_feature_layout(mesh);
  const auto quads = choose_corner_quads(mesh, *layout);
  for (const std::uint32_t corner : mesh.corners) EXPECT_EQ(quads[layout->nodes_of(corner)[0]], 1);
  EXPECT_EQ(quads[layout->nodes_of(1)[0]], 2);
}

}  // namespace
}  // namespace strataflow
