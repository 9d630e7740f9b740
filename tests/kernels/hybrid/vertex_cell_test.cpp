#include "kernels/hybrid/vertex_cell.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace strataflow {
namespace {

std::uint64_t count_of(const std::vector<ThinCell>& cells, CellType type) {
  return static_cast<std::uint64_t>(
      std::count_if(cells.begin(), cells.end(), [&](const ThinCell& cell) { return cell.type == type; }));
}

/// Both directions of the link between sites i and j in triple t.
void link(VertexNeighbourhood& around, std::size_t t, std::size_t i, std::uint32_t at_i, std::size_t j,
          std::uint32_t at_j) {
  around.links[t][i][j] = at_i;
  around.links[t][j][i] = at_j;
}

TEST(BuildVertexCell, four_sites_with_a_point_each_are_a_tetrahedron) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {}};
  const VertexCell cell = build_vertex_cell(
      VertexNeighbourhood::with_points({{{0, no_index}, {1, no_index}, {2, no_index}, {3, no_index}}}));
  EXPECT_EQ(cell.kind, VertexCellKind::tetrahedron);
  const auto cells = cells_of(cell, 4, points);
  ASSERT_TRUE(cells);
  EXPECT_EQ(count_of(*cells, CellType::tetrahedron), 1u);
}

/// Sites 0 … 3 at the corners of a unit square (0 and 2, 1 and 3 opposite), points 0 … 3 below and 4 … 7 above; below
/// the surface has the diagonal 0–2, above 1–3.
VertexNeighbourhood doubled_four_times() {
  VertexNeighbourhood around = VertexNeighbourhood::with_points({{{0, 4}, {1, 5}, {2, 6}, {3, 7}}});
  // Triples without 1 and without 3 hit the surface below (they hold 0 and 2), those without 0 and without 2 above.
  for (const std::size_t t : {std::size_t{0}, std::size_t{2}})
    for (std::uint32_t i = 0; i < 4; ++i)
      for (std::uint32_t j = 0; j < 4; ++j) around.links[t][i][j] = 4 + i;
  return around;
}

TEST(BuildVertexCell, four_doubled_facets_make_eight_vertices_that_split_into_tetrahedra_and_pyramids) {  // X12
  const VertexCell cell = build_vertex_cell(doubled_four_times());
  EXPECT_EQ(cell.two_point_cells, 4u);
  EXPECT_EQ(cell.doubled_facets, 4u);
  EXPECT_EQ(cell.vertex_count, 8u);
  EXPECT_EQ(cell.edges.size(), 14u);
  EXPECT_EQ(cell.facets.size(), 8u);
  EXPECT_EQ(cell.kind, VertexCellKind::to_subdivide);
  std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},      {0, 0, 1},
                           {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0.5, 0.5, 0.5}};
  auto cells = cells_of(cell, 8, points);
  if (!cells) {  // the sites turn the other way round
    VertexCell turned = cell;
    for (auto& facet : turned.facets) std::reverse(facet.begin(), facet.end());
    cells = cells_of(turned, 8, points);
  }
  ASSERT_TRUE(cells);
  EXPECT_EQ(count_of(*cells, CellType::tetrahedron), 4u);
  EXPECT_EQ(count_of(*cells, CellType::pyramid), 4u);
  double volume = 0;
  for (const ThinCell& made : *cells) volume += volume_of(made, points);
  EXPECT_NEAR(volume, 1, 1e-12);
}

TEST(BuildVertexCell, one_doubled_facet_makes_a_pyramid) {
  // Site 3 has points 3 (for 0 and 1 …) and 4: seen from triple 0 it is 4, else 3.
  VertexNeighbourhood around =
      VertexNeighbourhood::with_points({{{0, no_index}, {1, no_index}, {2, no_index}, {3, 4}}});
  link(around, 0, 1, 1, 3, 4);
  link(around, 0, 2, 2, 3, 4);
  link(around, 1, 2, 2, 3, 4);  // 2 sees 4 from both sides, 1 sees 3 and 4
  const VertexCell cell = build_vertex_cell(around);
  EXPECT_EQ(cell.vertex_count, 5u);
  EXPECT_EQ(cell.edges.size(), 8u);
  EXPECT_EQ(cell.facets.size(), 5u);
  EXPECT_EQ(cell.doubled_facets, 1u);
  EXPECT_EQ(cell.kind, VertexCellKind::pyramid);
}

TEST(DecideLinks, takes_the_better_angle) {  // X13
  // Site 3 has a point far away (3) and one near by (4); which of them site 1 is linked to, no surface says.
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, 9}, {0.3, 0.3, 1}};
  VertexNeighbourhood around =
      VertexNeighbourhood::with_points({{{0, no_index}, {1, no_index}, {2, no_index}, {3, 4}}});
  for (const std::size_t t : {std::size_t{0}, std::size_t{1}, std::size_t{2}})
    for (std::size_t j = 0; j < 3; ++j) around.links[t][3][j] = 4;
  around.links[0][3][1] = around.links[2][3][1] = no_index;
  EXPECT_EQ(build_vertex_cell(around).kind, VertexCellKind::ill_defined);
  EXPECT_EQ(decide_links(around, points), 1u);
  EXPECT_EQ(around.links[0][3][1], 4u);
  EXPECT_EQ(around.links[2][3][1], 4u);
  EXPECT_NE(build_vertex_cell(around).kind, VertexCellKind::ill_defined);
}

TEST(SplitSharedFacets, turns_a_cell_of_five_points_into_a_tetrahedron_and_a_triangle_between_neighbours) {  // X14
  // A, B, C and D with two points; A and C are linked to D2 = 4, B to D1 = 3: (5, 7, 4) is no polyhedron.
  VertexNeighbourhood around =
      VertexNeighbourhood::with_points({{{0, no_index}, {1, no_index}, {2, no_index}, {3, 4}}});
  for (const std::size_t t : {std::size_t{0}, std::size_t{1}, std::size_t{2}})
    for (std::size_t j = 0; j < 3; ++j) around.links[t][3][j] = j == 1 ? 3 : 4;
  VertexCell cell = build_vertex_cell(around);
  EXPECT_EQ(cell.vertex_count, 5u);
  EXPECT_EQ(cell.edges.size(), 7u);
  EXPECT_EQ(cell.facets.size(), 4u);
  EXPECT_EQ(cell.kind, VertexCellKind::invalid);
  EXPECT_EQ(split_shared_facets(cell), 1u);  // B, D1, D2
  EXPECT_EQ(cell.kind, VertexCellKind::tetrahedron);
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, 2}, {0, 0, 1}, {}};
  EXPECT_TRUE(cells_of(cell, 5, points));
}

}  // namespace
}  // namespace strataflow
