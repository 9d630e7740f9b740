#include "kernels/hexes/audit/diagnose_cells.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

/// A column of cubes.
HexGrid tower(std::uint32_t layers) {
  HexGrid grid;
  grid.plan.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  grid.plan.quads = {{0, 1, 2, 3}};
  grid.layers = layers;
  for (std::uint32_t level = 0; level <= layers; ++level)
    for (const Vec3& p : grid.plan.points) grid.mesh.points.push_back(p + Vec3{0, 0, double(level)});
  for (std::uint32_t k = 0; k < layers; ++k) {
    std::array<std::uint32_t, 8> v{};
    for (std::uint32_t c = 0; c < 8; ++c) v[c] = 4 * k + c;
    grid.mesh.add_cell(CellType::hexahedron, v.data(), 0);
    grid.cell_column.push_back(0);
    grid.cell_layer.push_back(k);
    grid.is_dead.push_back(0);
  }
  return grid;
}

CellDiagnosis diagnosed(const HexGrid& grid) { return diagnose_cells(grid, live_cells(grid)); }

TEST(DiagnoseCells, finds_nothing_in_a_tower_of_cubes) {
  CellDiagnosis diagnosis = diagnosed(tower(3));
  EXPECT_EQ(diagnosis.parts, 1u);
  diagnosis.parts = 0;
  std::uint64_t sum = 0;
  const auto add = [&](const char*, auto& field) {
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(field)>>)
      sum += field > 1e-12 ? 1 : 0;
    else
      sum += field.on_faults + field.elsewhere;
  };
  diagnosis.visit_fields(add);
  EXPECT_EQ(sum, 0u);
}

TEST(DiagnoseCells, counts_warped_faces_of_both_cells_that_share_them) {
  HexGrid grid = tower(2);
  grid.mesh.points[4].z += 0.4;  // its neighbours' mean plane is 0.1 away
  const CellDiagnosis diagnosis = diagnosed(grid);
  EXPECT_EQ(diagnosis.warped_faces, 2u);
  EXPECT_NEAR(diagnosis.largest_warpage_ratio, 0.1, 0.01);
  EXPECT_EQ(diagnosis.self_intersecting, 0u);
}

TEST(DiagnoseCells, joins_what_lies_below_and_above_a_cell_without_thickness) {
  HexGrid grid = tower(3);
  for (std::size_t k = 0; k < 4; ++k) grid.mesh.points[8 + k] = grid.mesh.points[4 + k];
  EXPECT_GT(diagnosed(grid).nonpositive_volumes, 0u);  // not yet called dead
  grid.is_dead[1] = 1;
  const CellDiagnosis diagnosis = diagnosed(grid);
  EXPECT_EQ(diagnosis.nonpositive_volumes, 0u);
  EXPECT_EQ(diagnosis.collocated_nodes.elsewhere, 0u);
  EXPECT_EQ(diagnosis.nonconforming_faces.elsewhere, 0u);
  EXPECT_EQ(diagnosis.parts, 1u);
}

TEST(DiagnoseCells, finds_a_lid_that_comes_through_the_floor) {
  std::array<Vec3, 8> p{Vec3{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  EXPECT_FALSE(is_self_intersecting(p));
  p[4].z = -0.4;
  EXPECT_TRUE(is_self_intersecting(p));
  p[4].z = 1;
  std::swap(p[6], p[7]);  // bow-ties
  EXPECT_TRUE(is_self_intersecting(p));
}

TEST(DiagnoseCells, finds_cells_that_are_not_convex_but_do_not_cross_themselves) {
  HexGrid grid = tower(1);
  grid.mesh.points[6] = {0.6, 0.6, 1};  // the upper corner pushed in: the sides beside it lean past the others
  grid.mesh.points[2] = {0.4, 0.4, 0};
  const CellDiagnosis diagnosis = diagnosed(grid);
  EXPECT_EQ(diagnosis.non_convex, 1u);
  EXPECT_EQ(diagnosis.self_intersecting, 0u);
}

}  // namespace
}  // namespace strataflow
