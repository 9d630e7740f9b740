#include "kernels/volumes/improve_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace strataflow {
namespace {

double volume_of(const Tet& t, const std::vector<Vec3>& points) {
  const Vec3& a = points[t[0]];
  return dot(cross(points[t[1]] - a, points[t[2]] - a), points[t[3]] - a) / 6;
}

double volume_of_tets(const ImprovableCells& cells) {
  double sum = 0;
  for (const Tet& t : cells.tets) sum += volume_of(t, cells.points);
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
    if (volume_of(t, cells.points) < 0) std::swap(t[0], t[1]);
  const std::vector<Vec3> before = cells.points;
  const CellImprovement improvement = improve_cells(cells);
  EXPECT_GT(improvement.moves, 0u);
  EXPECT_GT(improvement.smallest_after, 3 * improvement.smallest_before);
  for (std::size_t p = 0; p < 4; ++p) EXPECT_EQ(cells.points[p], before[p]);
  EXPECT_NEAR(volume_of_tets(cells), 1.0 / 6, 1e-12);
}

TEST(ImproveCells, sets_a_point_where_four_corners_lie_in_a_plane) {
  // A sliver on the ground below four tetrahedra: all corners fixed, its diagonal 2–3 is inside.
  ImprovableCells cells;
  cells.points = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0.003}, {0, 1, 0.003}, {0.5, 0.5, 1}};
  cells.is_free.assign(5, 0);
  cells.tets = {{0, 1, 2, 3}, {0, 2, 3, 4}, {1, 2, 3, 4}};
  for (Tet& t : cells.tets)
    if (volume_of(t, cells.points) < 0) std::swap(t[0], t[1]);
  cells.facets = {{0, 1, 2}, {0, 1, 3}, {0, 2, 4}, {0, 3, 4}, {1, 2, 4}, {1, 3, 4}};
  const double before = volume_of_tets(cells);
  const CellImprovement improvement = improve_cells(cells);
  EXPECT_GT(improvement.exchanges + improvement.added_points, 0u);
  EXPECT_GT(improvement.smallest_after, 20 * improvement.smallest_before);
  EXPECT_NEAR(volume_of_tets(cells), before, 1e-12);
}

TEST(ImproveCells, measures_dihedral_angles_by_their_smallest_sine) {
  // The same double pyramid round its axis: four dihedral angles of 90° at it, but sharp or blunt ones at its waist.
  ImprovableCells cells = double_pyramid(1);
  cells.measure = TetMeasure::smallest_sine;
  const CellImprovement improvement = improve_cells(cells);
  // Corners at distance 1: the normals (±1, 1, 1) of the slanting faces leave angles of acos(1/√3) at the slanting
  // edges.
  EXPECT_NEAR(improvement.smallest_before, std::sqrt(2.0 / 3), 1e-12);
  EXPECT_EQ(improvement.exchanges, 0u);
  cells = double_pyramid(6);
  cells.measure = TetMeasure::smallest_sine;
  const CellImprovement longer = improve_cells(cells);
  EXPECT_GE(longer.smallest_after, longer.smallest_before);
}

}  // namespace
}  // namespace strataflow
