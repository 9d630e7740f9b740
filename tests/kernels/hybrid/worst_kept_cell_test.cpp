#include "kernels/hybrid/worst_kept_cell.h"

#include <gtest/gtest.h>

#include "kernels/volumes/improve_cells.h"

namespace strataflow {
namespace {

TEST(WorstKeptCell, is_the_smallest_scaled_jacobian_at_a_point_and_1_where_there_is_no_cell) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -0.1}, {5, 5, 5}};
  const std::vector<ThinCell> kept{tetrahedron_of(0, 1, 2, 3), tetrahedron_of(0, 2, 1, 4)};
  const auto worst = worst_kept_cell(kept, points.size());
  EXPECT_LT(worst(0, points), worst(3, points));
  EXPECT_EQ(worst(0, points), worst(4, points));
  EXPECT_EQ(worst(5, points), 1);
  EXPECT_EQ(worst(6, points), 1);  // added later
  std::vector<Vec3> turned = points;
  turned[3].z = -1;
  EXPECT_EQ(worst(3, turned), 0);
}

TEST(WorstKeptCell, keeps_improve_cells_from_spoiling_cells_with_the_points_it_moves) {
  // A pyramid whose apex also belongs to four tetrahedra that would like it elsewhere.
  ImprovableCells cells;
  cells.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.1}, {0.5, 0.5, 0.15}};
  cells.is_free = {0, 0, 0, 0, 1, 0};
  const std::vector<ThinCell> kept{{CellType::pyramid, {0, 1, 2, 3, 4}}};
  cells.worst_kept_at = worst_kept_cell(kept, cells.points.size());
  for (std::uint32_t k = 0; k < 4; ++k) {
    cells.tets.push_back({4, 5, k, (k + 1) % 4});
    cells.facets.push_back({4, k, (k + 1) % 4});
    cells.facets.push_back({5, k, (k + 1) % 4});
  }
  const CellImprovement improvement = improve_cells(cells);
  EXPECT_EQ(state_of(kept[0], cells.points), ThinCellState::sound);
  EXPECT_GE(improvement.smallest_after, improvement.smallest_before);
}

}  // namespace
}  // namespace strataflow
