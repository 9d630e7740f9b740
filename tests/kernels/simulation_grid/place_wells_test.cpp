#include "kernels/simulation_grid/place_wells.h"

#include <gtest/gtest.h>

#include "kernels/simulation_grid/build_simulation_grid.h"
#include "support/hex_grids.h"

namespace strataflow {
namespace {

TEST(PlaceWells, run_through_the_columns_that_inclined_pillars_bring_below_them) {
  // Columns lean by 20 m in x per layer of 10 m; the well stands at x = 140.
  const HexGrid hexes = support::hex_grid(support::plan_grid(3, 1), 5,
                                          [](std::uint32_t, const Vec3& corner, std::uint32_t level) {
                                            return Vec3{corner.x + 20.0 * level, corner.y, 10.0 * level};
                                          },
                                          {}, {0, 0, 1, 1, 1});
  const auto grid = build_simulation_grid(hexes, {{"low"}, {"high"}}, {}, {GridLayout::native, {}});
  ASSERT_TRUE(grid) << describe(grid.failure());
  const auto wells = place_wells(hexes, *grid, {{"A", 140, 50}, {"B", 140, 50, {"low"}}});
  ASSERT_TRUE(wells) << describe(wells.failure());
  using Cells = std::vector<std::array<std::uint32_t, 3>>;
  EXPECT_EQ((*wells)[0].cells, (Cells{{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {1, 0, 3}, {1, 0, 4}}));
  EXPECT_EQ((*wells)[1].cells, (Cells{{1, 0, 3}, {1, 0, 4}}));
}

TEST(PlaceWells, refuse_a_well_outside_and_a_region_that_is_not_there) {
  const HexGrid hexes = support::box_grid(1, 1, 1);
  const auto grid = build_simulation_grid(hexes, {{"sand"}}, {});
  ASSERT_TRUE(grid);
  const auto outside = place_wells(hexes, *grid, {{"A", 500, 50}});
  ASSERT_FALSE(outside);
  EXPECT_NE(outside.failure().what.find("well A"), std::string::npos);
  EXPECT_FALSE(place_wells(hexes, *grid, {{"A", 50, 50, {"salt"}}}));
}

}  // namespace
}  // namespace strataflow
