#include "kernels/hexes/refinement/refine_quads.h"

#include <gtest/gtest.h>

#include "base/archive.h"
#include "kernels/quads/extraction/check_quads.h"
#include "kernels/quads/extraction/quad_quality.h"

namespace strataflow {
namespace {

/// Squares, I fastest, the two lowest rows parted by a feature.
QuadMesh squares(std::uint32_t columns, std::uint32_t rows) {
  QuadMesh plan;
  for (std::uint32_t j = 0; j <= rows; ++j)
    for (std::uint32_t i = 0; i <= columns; ++i) plan.points.push_back({3.0 * i, 3.0 * j, 0});
  const auto point = [&](std::uint32_t i, std::uint32_t j) { return i + (columns + 1) * j; };
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i)
      plan.quads.push_back({point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)});
  plan.features.push_back({"F", Role::fault, 0, -1});
  for (std::uint32_t i = 0; i < columns; ++i) plan.edges.push_back({point(i, 1), point(i + 1, 1), 0});
  return plan;
}

double area_m2(const QuadMesh& plan) {
  double area = 0;
  for (const auto& q : plan.quads)
    area += 0.5 * cross(plan.points[q[2]] - plan.points[q[0]], plan.points[q[3]] - plan.points[q[1]]).z;
  return area;
}

QuadMesh refined(const QuadMesh& plan, const std::vector<std::uint32_t>& fine, const std::vector<std::uint32_t>& kept = {}) {
  std::vector<char> is_fine(plan.quads.size(), 0), keeps(plan.points.size(), 0);
  for (const std::uint32_t q : fine) is_fine[q] = 1;
  for (const std::uint32_t p : kept) keeps[p] = 1;
  QuadMesh result = refine_quads(plan, is_fine, keeps);
  const Result<void> sound = check_quads(result);
  EXPECT_TRUE(sound) << describe(sound.failure());
  const QuadQuality quality = measure_quads(result);
  EXPECT_EQ(quality.inverted, 0u);
  EXPECT_GT(quality.scaled_jacobian.minimum, 0.7);  // 45° at worst
  EXPECT_NEAR(area_m2(result), area_m2(plan), 1e-9);
  return result;
}

TEST(RefineQuads, leaves_a_plan_as_it_is_where_nothing_is_fine) {
  const QuadMesh plan = squares(3, 3);
  EXPECT_EQ(archived(refined(plan, {})), archived(plan));
}

TEST(RefineQuads, cuts_a_quad_in_nine_and_those_around_so_that_all_conform) {
  // Four sides with two ends (7 each), four corners with one (3 each).
  EXPECT_EQ(refined(squares(3, 3), {4}).quads.size(), 9u + 4 * 7 + 4 * 3);
  EXPECT_EQ(refined(squares(1, 1), {0}).quads.size(), 9u);
}

TEST(RefineQuads, conforms_whatever_quads_are_fine) {
  const QuadMesh plan = squares(4, 4);
  for (std::uint32_t pattern = 1; pattern < 4096; pattern += 37) {
    std::vector<std::uint32_t> fine;
    for (std::uint32_t q = 0; q < 12; ++q)
      if (pattern >> q & 1) fine.push_back(q);
    refined(plan, fine);
    if (testing::Test::HasFailure()) FAIL() << "pattern " << pattern;
  }
}

TEST(RefineQuads, fills_the_corner_between_three_fine_quads_with_eight) {
  // Around the middle of 2 × 2: three fine quads mark three corners of the fourth and its middle one.
  const QuadMesh plan = squares(4, 4);
  const QuadMesh result = refined(plan, {0, 1, 4});
  std::size_t inside = 0;  // of the quad at (1, 1)
  for (const auto& q : result.quads) {
    const Vec3 middle = 0.25 * (result.points[q[0]] + result.points[q[1]] + result.points[q[2]] + result.points[q[3]]);
    inside += middle.x > 3 && middle.x < 6 && middle.y > 3 && middle.y < 6 ? 1 : 0;
  }
  EXPECT_EQ(inside, 8u);
}

TEST(RefineQuads, keeps_features_as_chains_of_edges) {
  const QuadMesh result = refined(squares(3, 3), {4});
  double length_m = 0;
  for (const FeatureEdge& edge : result.edges) {
    EXPECT_LT(edge.a, edge.b);
    EXPECT_EQ(result.points[edge.a].y, 3);
    length_m += length(result.points[edge.b] - result.points[edge.a]);
  }
  EXPECT_NEAR(length_m, 9, 1e-12);
  EXPECT_EQ(result.edges.size(), 2u + 3 + 2);
}

TEST(RefineQuads, leaves_edges_beside_kept_points_whole) {
  const QuadMesh plan = squares(4, 1);
  // The first two quads are a strip: nothing of them may be cut, whatever is asked.
  const QuadMesh result = refined(plan, {0, 1, 2, 3}, {0, 1, 2, 5, 6, 7});
  EXPECT_EQ(result.quads[0], plan.quads[0]);
  EXPECT_EQ(result.quads[1], plan.quads[1]);
  EXPECT_GT(result.quads.size(), plan.quads.size());
  // Two opposite corners alone cannot be cut.
  const QuadMesh none = refined(squares(1, 1), {0}, {0, 3});
  EXPECT_EQ(none.quads.size(), 1u);
}

}  // namespace
}  // namespace strataflow
