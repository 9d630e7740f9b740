#include "kernels/quads/field/separate_features.h"

#include <gtest/gtest.h>

#include "feature_shapes.h"
#include "kernels/quads/field/feature_layout.h"

namespace strataflow {
namespace {

TEST(SeparateFeatures, leaves_every_triangle_one_feature_edge_and_every_sector_a_point_inside) {
  for (const FeatureMesh& mesh : {support::square(1), support::wedge(1, 0.1), support::wedge(3, 0.02),
                                  support::square_with_fault(4), support::box_surface(1, 2, 3, 1)}) {
    const auto separate = separate_features(mesh);
    ASSERT_TRUE(separate);
    const auto layout = build_feature_layout(*separate);
    ASSERT_TRUE(layout);
    for (std::uint32_t t = 0; t < layout->triangle_count(); ++t)
      EXPECT_LE(layout->is_feature[3 * t] + layout->is_feature[3 * t + 1] + layout->is_feature[3 * t + 2], 1);
    for (std::uint32_t h = 0; h < layout->opposite.size(); ++h)
      if (!layout->is_feature[h]) {
        EXPECT_TRUE(layout->node_kind[layout->node_of[h]] == NodeKind::inside ||
                    layout->node_kind[layout->node_of[next_half_edge(h)]] == NodeKind::inside);
      }
    EXPECT_EQ(separate->edges.size(), mesh.edges.size());
    ASSERT_EQ(separate->changes.size(), 1u);
    double before = 0, after = 0;
    const auto original = build_feature_layout(mesh);
    for (const double area : original->area_m2) before += area;
    for (const double area : layout->area_m2) after += area;
    EXPECT_NEAR(before, after, 1e-12 * before);
  }
}

/// Twelve points of a circle around one: the field of a disc has four singular points of valence 3.
TEST(SeparateFeatures, makes_room_for_the_singular_points_of_a_compartment) {
  FeatureMesh wheel;
  std::vector<std::uint32_t> rim;
  for (std::uint32_t i = 0; i < 12; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 12;
    wheel.points.push_back({std::cos(angle), std::sin(angle), 0});
    wheel.triangles.push_back({i, (i + 1) % 12, 12});
    rim.push_back(i);
  }
  wheel.points.push_back({0, 0, 0});
  wheel.edge_length_m = 1;
  rim.push_back(0);
  support::add_feature(wheel, "rim", rim);
  const auto separate = separate_features(wheel);
  ASSERT_TRUE(separate);
  EXPECT_GE(separate->points.size(), 12u + 7u);
  EXPECT_EQ(separate->edges.size(), 12u);
  EXPECT_EQ(separate_features(*separate)->triangles, separate->triangles) << "once is enough";
}

TEST(SeparateFeatures, changes_nothing_where_nothing_reaches_from_feature_to_feature) {
  const FeatureMesh once = *separate_features(support::square(5));
  EXPECT_EQ(separate_features(once)->triangles, once.triangles);
}

}  // namespace
}  // namespace strataflow
