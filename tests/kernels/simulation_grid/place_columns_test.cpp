#include "kernels/simulation_grid/place_columns.h"

#include <gtest/gtest.h>

#include "kernels/simulation_grid/cell_contacts.h"
#include "support/hex_grids.h"

namespace strataflow {
namespace {

const std::vector<PlanBlock> one_column{{{1, 1}, {0}, {0}}};

TEST(CheapestHeight, is_that_of_all_pieces_where_they_are_equal) {
  EXPECT_EQ(cheapest_height(one_column, {{0, 0, 8}}, false), 8u);
  EXPECT_EQ(cheapest_height(one_column, {{0, 0, 3}, {0, 3, 6}}, false), 3u);
}

TEST(CheapestHeight, cuts_a_long_piece_rather_than_leave_many_short_ones_in_empty_places) {
  std::vector<ColumnPiece> pieces{{0, 0, 12}};
  for (std::uint32_t n = 0; n < 40; ++n) pieces.push_back({0, n, n + 2});
  EXPECT_EQ(cheapest_height(one_column, pieces, false), 2u);
  // Only a few short ones: their empty places cost less than pillars and connections of a long one in parts.
  EXPECT_EQ(cheapest_height(one_column, {{0, 0, 12}, {0, 0, 12}, {0, 0, 12}, {0, 0, 11}, {0, 11, 12}}, false), 12u);
}

TEST(DeckCost, counts_places_pillars_and_connections) {
  const QuadMesh plan = support::plan_grid(2, 1);
  const auto opposite = *opposite_half_edges(plan);
  const auto apart = single_blocks(plan);
  const DeckCost row = deck_cost(plan, opposite, apart, {{0, 0, 4}, {1, 0, 2}, {1, 2, 4}}, 4, 4, false);
  EXPECT_EQ(row.places, 3 * 2 * 4);
  EXPECT_EQ(row.pillars, 3 * 4);
  EXPECT_EQ(row.connections, 1 + 4);  // one cut, four layers side by side
  const std::vector<PlanBlock> together{*native_block(plan, opposite)};
  const DeckCost packed = deck_cost(plan, opposite, together, {{0, 0, 2}, {0, 2, 4}}, 4, 2, true);
  EXPECT_EQ(packed.places, 2 * (3 * 2) * 2);
  EXPECT_EQ(packed.pillars, 2 * (3 * 2));
  EXPECT_EQ(packed.connections, 2);
}

TEST(PlaceColumns, takes_the_layout_with_the_fewest_numbers) {
  // Around a singular vertex: rectangles where columns can share pillars, a row of columns where none can.
  for (const bool is_parted : {false, true}) {
    const HexGrid grid = support::hex_grid(
        support::plan_star(3, 2), 2, [&](std::uint32_t quad, const Vec3& corner, std::uint32_t level) {
          return Vec3{corner.x + (is_parted ? 20.0 * quad : 0), corner.y, 10.0 * level};
        });
    const auto cells = *cells_by_column(grid);
    const auto opposite = *opposite_half_edges(grid.plan);
    const auto placed = place_columns(grid, cells, opposite, GridLayout::automatic, 1);
    ASSERT_TRUE(placed);
    EXPECT_EQ(placed->layout, is_parted ? "unstructured" : "blocks");
    EXPECT_NE(placed->reason.find("singular"), std::string::npos);
    EXPECT_EQ(placed->height, 2u);
  }
}

}  // namespace
}  // namespace strataflow
