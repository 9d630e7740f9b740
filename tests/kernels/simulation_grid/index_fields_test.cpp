#include "kernels/simulation_grid/index_fields.h"

#include <gtest/gtest.h>

#include "kernels/simulation_grid/build_simulation_grid.h"
#include "support/hex_grids.h"

namespace strataflow {
namespace {

TEST(IndexFields, name_column_layer_and_place_of_every_hexahedron) {
  const HexGrid hexes = support::box_grid(2, 1, 2);
  const auto grid = build_simulation_grid(hexes, {{"sand"}}, {}, {GridLayout::unstructured, {}});
  ASSERT_TRUE(grid);
  const auto fields = index_fields(hexes, *grid);
  using Values = std::vector<double>;
  ASSERT_EQ(fields.size(), 5u);
  EXPECT_EQ(fields[0].values, (Values{0, 0, 1, 1}));
  EXPECT_EQ(fields[1].values, (Values{0, 1, 0, 1}));
  EXPECT_EQ(fields[2].name, "i");
  EXPECT_EQ(fields[2].values, (Values{1, 1, 3, 3}));
  EXPECT_EQ(fields[4].values, (Values{2, 1, 2, 1}));  // K counts from the top
}

}  // namespace
}  // namespace strataflow
