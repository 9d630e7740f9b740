#include "kernels/simulation_grid/cell_contacts.h"

#include <gtest/gtest.h>

#include <map>

#include "kernels/simulation_grid/plan_blocks.h"
#include "support/hex_grids.h"

namespace strataflow {
namespace {

std::vector<CellContact> contacts_of(const HexGrid& grid) {
  const auto cells = cells_by_column(grid);
  const auto opposite = opposite_half_edges(grid.plan);
  EXPECT_TRUE(cells && opposite);
  return find_cell_contacts(grid, *cells, *opposite);
}

TEST(OverlapArea, of_shifted_squares_is_what_both_cover) {
  const std::array<Vec3, 4> first{Vec3{0, 0, 0}, {4, 0, 0}, {4, 0, 2}, {0, 0, 2}};
  const std::array<Vec3, 4> second{Vec3{4, 0, 0.5}, {0, 0, 0.5}, {0, 0, 9}, {4, 0, 9}};
  const Vec3 area = overlap_area(first, second);
  EXPECT_NEAR(area.y, -6, 1e-14);
  EXPECT_NEAR(length(area), 6, 1e-14);
}

TEST(OverlapArea, of_a_tilted_band_across_a_square_is_exact) {
  // Heights 0 … 1 against a band of height 1 that rises from −1 to 1 over a width of 2: two triangles are missing.
  const std::array<Vec3, 4> first{Vec3{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {0, 0, 1}};
  const std::array<Vec3, 4> second{Vec3{2, 0, 1}, {0, 0, -1}, {0, 0, 0}, {2, 0, 2}};
  EXPECT_NEAR(length(overlap_area(first, second)), 1.0, 1e-14);
}

TEST(OverlapArea, is_nothing_where_sides_only_share_an_edge) {
  const std::array<Vec3, 4> first{Vec3{0, 0, 0}, {2, 0, 0}, {2, 0, 1}, {0, 0, 1}};
  const std::array<Vec3, 4> second{Vec3{2, 0, 1}, {0, 0, 1}, {0, 0, 2}, {2, 0, 2}};
  EXPECT_EQ(length(overlap_area(first, second)), 0.0);
}

TEST(OverlapArea, is_measured_on_an_inclined_plane_with_pillars_that_converge) {
  // Both in the plane x = z / 2; the second covers the upper half of the first.
  const std::array<Vec3, 4> first{Vec3{0, 0, 0}, {0, 4, 0}, {1, 3, 2}, {1, 1, 2}};
  const std::array<Vec3, 4> second{Vec3{0.5, 3.5, 1}, {0.5, 0.5, 1}, {1.5, 1.5, 3}, {1.5, 2.5, 3}};
  // Between the heights 1 and 2 both narrow from 3 to 2.
  EXPECT_NEAR(length(overlap_area(first, second)), 2.5 * std::sqrt(1.25), 1e-13);
}

TEST(CellContacts, of_a_box_are_its_inner_faces) {
  const auto contacts = contacts_of(support::box_grid(3, 2, 4));
  EXPECT_EQ(contacts.size(), 2u * 2 * 4 + 3u * 1 * 4 + 6u * 3);
  double area = 0;
  for (const CellContact& contact : contacts) {
    EXPECT_TRUE(contact.is_whole);
    area += length(contact.area);
  }
  EXPECT_NEAR(area, 28 * 1000.0 + 18 * 10000.0, 1e-6);
}

TEST(CellContacts, across_an_offset_fault_cover_exactly_what_both_sides_share) {
  // Four layers of 10 m, 15 m of throw: 25 m are in contact along 200 m, in five overlaps per edge.
  const auto contacts = contacts_of(support::faulted_grid(2, 2, 4, 1, 15, 0.5));
  double area = 0;
  int overlaps = 0;
  for (const CellContact& contact : contacts)
    if (contact.fault != no_index) area += length(contact.area), ++overlaps;
  EXPECT_EQ(overlaps, 2 * 5);
  EXPECT_NEAR(area, 200 * 25 * std::sqrt(1.25), 1e-8);
}

TEST(CellContacts, look_over_dead_cells) {
  const HexGrid grid =
      support::hex_grid(support::plan_grid(1, 1), 3, [](std::uint32_t, const Vec3& corner, std::uint32_t level) {
        return Vec3{corner.x, corner.y, 10.0 * (level > 1 ? level - 1 : level)};
      });
  ASSERT_EQ(grid.is_dead, (std::vector<std::uint8_t>{0, 1, 0}));
  const auto contacts = contacts_of(grid);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].cell_0, 0u);
  EXPECT_EQ(contacts[0].cell_1, 2u);
  EXPECT_NEAR(contacts[0].area.z, 10000, 1e-9);
}

TEST(CellsByColumn, refuse_a_grid_with_a_missing_or_doubled_cell) {
  HexGrid grid = support::box_grid(2, 1, 2);
  grid.cell_layer[0] = 1;
  ASSERT_FALSE(cells_by_column(grid));
  EXPECT_EQ(cells_by_column(grid).failure().code, FailureCode::invalid_input);
  grid = support::box_grid(2, 1, 2);
  grid.layers = 3;
  EXPECT_FALSE(cells_by_column(grid));
  grid = support::box_grid(2, 1, 2);
  grid.mesh.points[0].x = std::nan("");
  EXPECT_FALSE(cells_by_column(grid));
}

}  // namespace
}  // namespace strataflow
