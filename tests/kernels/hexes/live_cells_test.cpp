#include "kernels/hexes/live_cells.h"

#include <gtest/gtest.h>

#include "kernels/quality/match_cell_faces.h"
#include "support/hex_grids.h"

namespace strataflow {
namespace {

/// Two columns of three layers; the middle one of the second has no thickness on its right side, or none at all.
HexGrid two_columns(double thickness_at_middle_m) {
  HexGrid grid = support::hex_grid(support::plan_grid(2, 1), 3, [&](std::uint32_t, const Vec3& p, std::uint32_t level) {
    const double thickness = p.x < 50 ? 10 : p.x < 150 ? thickness_at_middle_m : 0;
    return Vec3{p.x, p.y, level == 0 ? 0 : level == 1 ? 10 : level == 2 ? 10 + thickness : 20 + thickness};
  });
  grid.mesh.facets.clear();
  return grid;
}

TEST(LiveCells, leave_dead_cells_out_and_join_what_is_above_and_below) {
  const HexGrid grid = two_columns(0);
  const LiveCells live = live_cells(grid);
  ASSERT_EQ(grid.is_dead[4], 1);
  EXPECT_EQ(live.grid_cell, (std::vector<std::uint32_t>{0, 1, 2, 3, 5}));
  const FaceMatching faces = match_cell_faces(live.mesh);
  EXPECT_EQ(faces.nonconforming_faces, 0u);
  EXPECT_EQ(faces.inner_faces, 2u + 1u + 2u);  // in both columns, and between them below and above
}

TEST(LiveCells, a_cell_that_ends_in_an_edge_uses_its_points_twice) {
  const LiveCells live = live_cells(two_columns(4));
  ASSERT_EQ(live.mesh.cell_count(), 6u);
  const std::uint32_t* wedge = &live.mesh.cell_vertices[8 * 4];
  int repeated = 0;
  for (int k = 0; k < 4; ++k) repeated += wedge[k] == wedge[k + 4] ? 1 : 0;
  EXPECT_EQ(repeated, 2);
  EXPECT_EQ(match_cell_faces(live.mesh).nonconforming_faces, 0u);
}

TEST(LiveCells, a_facet_through_dead_cells_lies_between_the_live_ones_once) {
  HexGrid grid = two_columns(0);
  const auto top_of = [&](std::uint32_t cell) {
    const std::uint32_t* v = &grid.mesh.cell_vertices[8 * cell + 4];
    return std::array<std::uint32_t, 4>{v[0], v[1], v[2], v[3]};
  };
  grid.mesh.facets = {{top_of(3), 0, 3, 4}, {top_of(4), 0, 4, 5}, {top_of(5), 0, 5, no_index}};
  const LiveCells live = live_cells(grid);
  ASSERT_EQ(live.mesh.facets.size(), 2u);
  EXPECT_EQ(live.mesh.facets[0].cell_0, 3u);
  EXPECT_EQ(live.mesh.facets[0].cell_1, 4u);
  EXPECT_EQ(live.mesh.facets[1].cell_0, 4u);
  EXPECT_EQ(live.mesh.facets[1].cell_1, no_index);
}

}  // namespace
}  // namespace strataflow
