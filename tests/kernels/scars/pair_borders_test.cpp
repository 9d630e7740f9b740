#include "kernels/scars/pair_borders.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/shapes.h"

namespace strataflow {
namespace {

/// Triangles around the edge from (0,0,0) to (0,0,1), one per angle, patches of one entity; all run up or down the edge
/// by turns, so that neighbours face each other.
TriangleSoup leaves(const std::vector<double>& angles_rad, bool all_run_up = false) {
  TriangleSoup soup;
  const std::uint32_t patch = support::add_patch(soup, "F");
  for (std::size_t i = 0; i < angles_rad.size(); ++i) {
    if (i > 0) soup.patch_entity.push_back(0);
    const Vec3 low{0, 0, 0}, high{0, 0, 1}, apex{std::cos(angles_rad[i]), std::sin(angles_rad[i]), 0.5};
    const bool up = all_run_up || i % 2 == 0;
    support::add_triangle(soup, patch + static_cast<std::uint32_t>(i), up ? low : high, up ? high : low, apex);
  }
  return soup;
}

PairedBorders pair(const TriangleSoup& soup, const std::vector<EdgePlace>& split = {}) {
  return pair_borders(soup, find_mates(soup.points.size(), soup.triangles, soup.triangle_patch), split);
}

constexpr double pi = std::numbers::pi;

TEST(PairBorders, two_lips_pair_up_to_a_fold_of_forty_five_degrees) {
  for (int degrees = 0; degrees <= 180; degrees += 5) {
    if (degrees == 135) continue;  // the limit itself is a matter of rounding
    const PairedBorders paired = pair(leaves({0, pi * degrees / 180}));
    EXPECT_EQ(paired.pairs.size(), degrees > 135 ? 1u : 0u) << degrees;
    // At 0 the two triangles coincide in all three edges.
    EXPECT_EQ(paired.refused.size(), degrees > 135 ? 0u : degrees == 0 ? 6u : 2u) << degrees;
  }
}

TEST(PairBorders, the_more_lips_the_flatter_a_pair_must_be) {
  // n = 3: 30 degrees; n = 4: 22.5 degrees.
  EXPECT_EQ(pair(leaves({0, pi - 0.50, 0.3})).pairs.size(), 1u);
  EXPECT_EQ(pair(leaves({0, pi - 0.55, 0.3})).pairs.size(), 0u);
  EXPECT_EQ(pair(leaves({0, pi - 0.38, 0.6, 1.2})).pairs.size(), 1u);
  EXPECT_EQ(pair(leaves({0, pi - 0.41, 0.6, 1.2})).pairs.size(), 0u);
}

TEST(PairBorders, of_four_with_three_nearly_in_one_plane_only_the_best_two_pair) {
  const PairedBorders paired = pair(leaves({0, pi + 0.05, 1.6, pi - 0.2}));  // figure 2-12
  ASSERT_EQ(paired.pairs.size(), 1u);
  EXPECT_EQ(paired.pairs[0].first / 3, 0u);
  EXPECT_EQ(paired.pairs[0].second / 3, 1u);
  EXPECT_NEAR(paired.pairs[0].deviation_rad, 0.05, 1e-12);
  ASSERT_EQ(paired.refused.size(), 2u);
  EXPECT_EQ(paired.refused[0].reason, LipRefusal::fold);
  EXPECT_EQ(paired.refused[1].reason, LipRefusal::taken);
}

TEST(PairBorders, a_cube_keeps_its_twelve_edges) {  // figure 2-3, rule R1
  TriangleSoup soup;
  support::add_box(soup, support::add_patch(soup, "cube"), {0, 0, 0}, {1, 1, 1});
  // One point per face corner: each face is whole, faces touch by position only.
  std::vector<Triangle> faces;
  soup.patch_entity.assign(6, 0);
  for (std::uint32_t t = 0; t < 12; ++t) {
    soup.triangle_patch[t] = t / 2;
    faces.push_back(t % 2 == 0 ? Triangle{3 * t, 3 * t + 1, 3 * t + 2} : Triangle{3 * t - 3, 3 * t - 1, 3 * t + 2});
  }
  soup.triangles = faces;
  const PairedBorders paired = pair(soup);
  EXPECT_TRUE(paired.pairs.empty());
  EXPECT_EQ(paired.refused.size(), 24u);
  for (const RefusedLip& lip : paired.refused) EXPECT_EQ(lip.reason, LipRefusal::fold);
}

TEST(PairBorders, lips_with_opposite_normals_stay_apart) {
  const PairedBorders paired = pair(leaves({0, pi}, true));
  EXPECT_TRUE(paired.pairs.empty());
  ASSERT_EQ(paired.refused.size(), 2u);
  EXPECT_EQ(paired.refused[0].reason, LipRefusal::orientation);
}

TEST(PairBorders, lips_of_different_surfaces_are_contacts_not_scars) {
  TriangleSoup soup = leaves({0, pi});
  soup.entities.push_back({"other", Role::unknown});
  soup.patch_entity[1] = 1;
  const PairedBorders paired = pair(soup);
  EXPECT_TRUE(paired.pairs.empty());
  EXPECT_TRUE(paired.refused.empty());
}

TEST(PairBorders, only_selected_lines_are_looked_at) {
  const TriangleSoup soup = leaves({0, pi});
  EXPECT_EQ(pair(soup, {{Vec3{0, 0, 1}, Vec3{0, 0, 0}}}).pairs.size(), 1u);
  EXPECT_TRUE(pair(soup, {{Vec3{5, 0, 1}, Vec3{0, 0, 0}}}).pairs.empty());
}

TEST(PairBorders, a_triangle_without_area_pairs_with_nothing) {
  TriangleSoup soup = leaves({0, pi});
  soup.points[5] = {0, 0, 0.5};
  EXPECT_TRUE(pair(soup).pairs.empty());
}

}  // namespace
}  // namespace strataflow
