#include "io/simulator/corner_point_hexahedra.h"

#include <gtest/gtest.h>

#include <limits>

#include "io/simulator/sample_grids.h"

namespace strataflow {
namespace {

/// The determinant at the first corner of a cell.
double first_determinant(const VolumeMesh& mesh, std::size_t cell) {
  const auto p = [&](int v) { return mesh.points[mesh.cell_vertices[8 * cell + static_cast<std::size_t>(v)]]; };
  return dot(cross(p(1) - p(0), p(3) - p(0)), p(4) - p(0));
}

TEST(HexahedraOf, join_cells_at_equal_corners) {
  const InputData data = hexahedra_of(support::regular_grid(2, 2, 2).grid, {7, 8});
  EXPECT_EQ(data.volume.cell_count(), 8u);
  EXPECT_EQ(data.volume.points.size(), 27u);
  EXPECT_EQ(data.volume.cell_region, (std::vector<std::int32_t>{7, 7, 7, 7, 8, 8, 8, 8}));
  for (std::size_t cell = 0; cell < 8; ++cell) EXPECT_GT(first_determinant(data.volume, cell), 0);
}

TEST(HexahedraOf, turn_a_mirrored_grid_over) {
  CornerPointGrid grid = support::regular_grid(2, 1, 1).grid;
  for (Vec3& point : grid.pillars) point.y = -point.y;
  const InputData data = hexahedra_of(grid);
  for (std::size_t cell = 0; cell < 2; ++cell) EXPECT_GT(first_determinant(data.volume, cell), 0);
}

TEST(HexahedraOf, leave_out_what_is_inactive_or_without_height) {
  CornerPointGrid grid = support::regular_grid(3, 1, 1).grid;
  grid.is_active[0] = 0;
  for (std::uint32_t c = 0; c < 4; ++c)
    grid.corner_z[grid.corner({2, 0, 0}, c & 1, c >> 1, 1)] = grid.corner_z[grid.corner({2, 0, 0}, c & 1, c >> 1, 0)];
  const InputData data = hexahedra_of(grid);
  EXPECT_EQ(data.volume.cell_count(), 1u);
  ASSERT_EQ(data.warnings.size(), 1u);
  EXPECT_EQ(data.warnings[0].kind, "cells_without_height");
}

TEST(HexahedraOf, leave_out_corners_that_a_flat_pillar_throws_to_infinity) {
  CornerPointGrid grid = support::regular_grid(2, 1, 1).grid;
  grid.pillars[0].x = 1e300;
  grid.pillars[1].z = grid.pillars[0].z - std::numeric_limits<double>::denorm_min() - 1e-12;
  const InputData data = hexahedra_of(grid);
  EXPECT_EQ(data.volume.cell_count(), 1u);
  ASSERT_FALSE(data.warnings.empty());
  EXPECT_EQ(data.warnings[0].kind, "cells_nowhere");
}

TEST(HexahedraOf, bring_back_the_local_origin) {
  CornerPointGrid grid = support::regular_grid(1, 1, 1).grid;
  grid.local_origin = {1000, 2000, 0};
  EXPECT_EQ(hexahedra_of(grid).volume.points[0], (Vec3{1000, 2000, -1010}));
}

}  // namespace
}  // namespace strataflow
