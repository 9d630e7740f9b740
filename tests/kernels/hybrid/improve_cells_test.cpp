#include "kernels/hybrid/improve_cells.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace strataflow {
namespace {

double volume_of_tets(const ImprovableCells& cells) {
  double sum = 0;
  for (const Tet& t : cells.tets) sum += volume_of(tetrahedron_of(t[0], t[1], t[2], t[3]), cells.points);
  return sum;
}

/// Whether any tetrahedron has this edge.
bool has_edge(const ImprovableCells& cells, std::uint32_t a, std::uint32_t b) {
  return std::any_of(cells.tets.begin(), cells.tets.end(), [&](const Tet& t) {
    return std::find(t.begin(), t.end(), a) != t.end() && std::find(t.begin(), t.end(), b) != t.end();
  });
}

/// A flat double pyramid over a square: four tetrahedra round its short axis 0–1, or what else fills it.
ImprovableCells double_pyramid(double half_height) {
  ImprovableCells cells;
  cells.points = {{0, 0, -half_height}, {0, 0, half_height}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  cells.is_free.assign(6, 0);
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint32_t c = 2 + k, d = 2 + (k + 1) % 4;
    cells.tets.push_back({0, 1, c, d});
    cells.facets.push_back({0, c, d});
    cells.facets.push_back({1, c, d});
  }
  return cells;
}

TEST(ImproveCells, takes_a_long_edge_out_of_its_ring) {
  ImprovableCells cells = double_pyramid(6);
  const double before = volume_of_tets(cells);
  const CellImprovement improvement = improve_cells(cells);
  EXPECT_GT(improvement.exchanges, 0u);
  EXPECT_FALSE(has_edge(cells, 0, 1) && cells.points.size() == 6);
  EXPECT_GT(improvement.smallest_after, improvement.smallest_before);
  EXPECT_NEAR(volume_of_tets(cells), before, 1e-12);
}

TEST(ImproveCells, keeps_facets_and_the_edges_on_them) {
  ImprovableCells cells = double_pyramid(6);
  cells.facets.push_back({0, 1, 2});  // a fault that ends at the axis
  const std::vector<Tet> before = cells.tets;
  improve_cells(cells);
  EXPECT_TRUE(has_edge(cells, 0, 1));
  EXPECT_TRUE(std::any_of(cells.tets.begin(), cells.tets.end(), [](const Tet& t) {
    return std::count_if(t.begin(), t.end(), [](std::uint32_t v) { return v <= 2; }) == 3;
  }));
}

TEST(ImproveCells, moves_a_free_point_to_where_its_worst_cell_is_better_and_no_other) {
  ImprovableCells cells;
  cells.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.32, 0.32, 0.335}};  // almost on the far face
  cells.is_free = {0, 0, 0, 0, 1};
  cells.tets = {{0, 2, 1, 4}, {0, 1, 3, 4}, {0, 3, 2, 4}, {1, 2, 3, 4}};
  cells.facets = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  for (Tet& t : cells.tets)
    if (volume_of(tetrahedron_of(t[0], t[1], t[2], t[3]), cells.points) < 0) std::swap(t[0], t[1]);
  const std::vector<Vec3> before = cells.points;
  const CellImprovement improvement = improve_cells(cells);
  EXPECT_GT(improvement.moves, 0u);
  EXPECT_GT(improvement.smallest_after, 3 * improvement.smallest_before);
  for (std::size_t p = 0; p < 4; ++p) EXPECT_EQ(cells.points[p], before[p]);
  EXPECT_NEAR(volume_of_tets(cells), 1.0 / 6, 1e-12);
}

TEST(ImproveCells, does_not_spoil_kept_cells_with_the_points_it_moves) {
  // A pyramid whose apex also belongs to four tetrahedra that would like it elsewhere.
  ImprovableCells cells;
  cells.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.1}, {0.5, 0.5, 0.15}};
  cells.is_free = {0, 0, 0, 0, 1, 0};
  cells.kept.push_back({CellType::pyramid, {0, 1, 2, 3, 4}});
  for (std::uint32_t k = 0; k < 4; ++k) {
    cells.tets.push_back({4, 5, k, (k + 1) % 4});
    cells.facets.push_back({4, k, (k + 1) % 4});
    cells.facets.push_back({5, k, (k + 1) % 4});
  }
  const CellImprovement improvement = improve_cells(cells);
  EXPECT_EQ(state_of(cells.kept[0], cells.points), CellState::sound);
  EXPECT_GE(improvement.smallest_after, improvement.smallest_before);
  EXPECT_EQ(has_edge(cells, 4, 5), true);
}

TEST(ImproveCells, sets_a_point_where_four_corners_lie_in_a_plane) {
  // A sliver on the ground below four tetrahedra: all corners fixed, its diagonal 2–3 is inside.
  ImprovableCells cells;
  cells.points = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0.003}, {0, 1, 0.003}, {0.5, 0.5, 1}};
  cells.is_free.assign(5, 0);
  cells.tets = {{0, 1, 2, 3}, {0, 2, 3, 4}, {1, 2, 3, 4}};
  for (Tet& t : cells.tets)
    if (volume_of(tetrahedron_of(t[0], t[1], t[2], t[3]), cells.points) < 0) std::swap(t[0], t[1]);
  cells.facets = {{0, 1, 2}, {0, 1, 3}, {0, 2, 4}, {0, 3, 4}, {1, 2, 4}, {1, 3, 4}};
  const double before = volume_of_tets(cells);
  const CellImprovement improvement = improve_cells(cells);
  EXPECT_GT(improvement.exchanges + improvement.added_points, 0u);
  EXPECT_GT(improvement.smallest_after, 20 * improvement.smallest_before);
  EXPECT_NEAR(volume_of_tets(cells), before, 1e-12);
}

}  // namespace
}  // namespace strataflow
