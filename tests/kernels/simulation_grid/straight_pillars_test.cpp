#include "kernels/simulation_grid/straight_pillars.h"

#include <gtest/gtest.h>

#include "kernels/simulation_grid/cell_contacts.h"
#include "support/hex_grids.h"

namespace strataflow {
namespace {

/// Layers of 10 m whose columns lean ever more with depth: x moves by t² / 100 at t metres below the top.
HexGrid listric_grid(std::uint32_t layers) {
  return support::hex_grid(support::plan_grid(2, 1), layers,
                           [&](std::uint32_t, const Vec3& corner, std::uint32_t level) {
                             const double depth = 10.0 * (layers - level);
                             return Vec3{corner.x - depth * depth / 100, corner.y, -depth};
                           });
}

TEST(StraightPillar, goes_through_the_ends_and_tells_how_far_the_rest_is) {
  const StraightPillar pillar = straight_pillar({{0, 0, 0}, {5, 0, 10}, {4, 3, 5}});
  EXPECT_EQ(pillar.upper, (Vec3{5, 0, 10}));
  EXPECT_EQ(pillar.lower, (Vec3{0, 0, 0}));
  EXPECT_NEAR(pillar.deviation_m, std::hypot(1.5, 3), 1e-14);
}

TEST(StraightPillar, stands_upright_where_all_points_have_one_height) {
  const StraightPillar pillar = straight_pillar({{1, 2, 3}, {1, 2, 3}});
  EXPECT_EQ(pillar.lower, (Vec3{1, 2, 2}));
  EXPECT_EQ(pillar.deviation_m, 0);
}

TEST(SplitAtBentPillars, keeps_straight_columns_whole_and_cuts_bent_ones) {
  const HexGrid grid = listric_grid(8);
  const auto cells = *cells_by_column(grid);
  std::vector<PlanBlock> blocks = single_blocks(grid.plan);
  EXPECT_EQ(split_at_bent_pillars(grid, cells, blocks, 100).size(), 2u);
  // A chord over n layers leaves the parabola by (10 n / 2)² / 100 at most: n ≤ 2 for 1 m.
  const auto pieces = split_at_bent_pillars(grid, cells, blocks, 1.0001);
  ASSERT_EQ(pieces.size(), 8u);
  for (const ColumnPiece& piece : pieces) EXPECT_EQ(piece.high - piece.low, 2u);
}

TEST(SplitAtBentPillars, makes_no_piece_higher_than_asked) {
  const HexGrid grid = listric_grid(8);
  const auto cells = *cells_by_column(grid);
  std::vector<PlanBlock> blocks = single_blocks(grid.plan);
  const auto pieces = split_at_bent_pillars(grid, cells, blocks, 100, 3);
  ASSERT_EQ(pieces.size(), 6u);
  for (std::size_t p = 0; p < 3; ++p) EXPECT_EQ(pieces[p].high - pieces[p].low, p < 2 ? 3u : 2u);
}

TEST(SplitAtBentPillars, cuts_a_block_in_all_its_columns_at_once) {
  const HexGrid grid = listric_grid(8);
  const auto cells = *cells_by_column(grid);
  std::vector<PlanBlock> blocks{*native_block(grid.plan, *opposite_half_edges(grid.plan))};
  EXPECT_EQ(split_at_bent_pillars(grid, cells, blocks, 1.0001).size(), 4u);
  EXPECT_EQ(blocks.size(), 1u);
}

TEST(SplitAtBentPillars, takes_a_block_apart_where_its_columns_cannot_share_a_pillar) {
  // The sides of the fault stand at the same heights in different places.
  const HexGrid grid =
      support::hex_grid(support::plan_grid(2, 1), 2, [](std::uint32_t quad, const Vec3& corner, std::uint32_t level) {
        return Vec3{corner.x + (corner.x == 100 && quad == 1 ? 5 : 0), corner.y, 10.0 * level};
      });
  const auto cells = *cells_by_column(grid);
  std::vector<PlanBlock> blocks{*native_block(grid.plan, *opposite_half_edges(grid.plan))};
  EXPECT_EQ(split_at_bent_pillars(grid, cells, blocks, 1).size(), 2u);
  EXPECT_EQ(blocks.size(), 2u);
}

}  // namespace
}  // namespace strataflow
