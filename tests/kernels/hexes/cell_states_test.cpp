#include "kernels/hexes/cell_states.h"

#include <gtest/gtest.h>

#include <functional>

namespace strataflow {
namespace {

HexGrid cube() {
  HexGrid grid;
  grid.plan.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  grid.plan.quads = {{0, 1, 2, 3}};
  grid.layers = 1;
  grid.mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const std::array<std::uint32_t, 8> v{0, 1, 2, 3, 4, 5, 6, 7};
  grid.mesh.add_cell(CellType::hexahedron, v.data(), 0);
  grid.cell_column = grid.cell_layer = {0};
  grid.is_dead = {0};
  return grid;
}

CellState state_of(const std::function<void(std::vector<Vec3>&)>& change) {
  HexGrid grid = cube();
  change(grid.mesh.points);
  return cell_states(grid).front();
}

TEST(CellStates, tells_whole_cells_from_those_that_have_closed) {
  EXPECT_EQ(state_of([](auto&) {}), CellState::whole);
  EXPECT_EQ(state_of([](auto& p) { p[4].z = 1e-9; }), CellState::wedge);
  EXPECT_EQ(state_of([](auto& p) { p[4].z = p[5].z = 0; }), CellState::wedge);
  EXPECT_EQ(state_of([](auto& p) { p[4].z = p[5].z = p[6].z = 0; }), CellState::wedge);
  EXPECT_EQ(state_of([](auto& p) { p[4].z = p[5].z = p[6].z = p[7].z = 0; }), CellState::dead);
}

TEST(CellStates, finds_inverted_corners_in_whole_cells_and_in_wedges) {
  EXPECT_EQ(state_of([](auto& p) { p[4].z = -0.5; }), CellState::inverted);
  EXPECT_EQ(state_of([](auto& p) { p[6] = {0.2, 0.2, 1}; }), CellState::inverted);
  EXPECT_EQ(state_of([](auto& p) {
              p[4].z = 0;
              p[6].z = -0.5;
            }),
            CellState::inverted);
}

TEST(CellStates, marks_the_ends_of_closed_edges) {
  HexGrid grid = cube();
  grid.mesh.points[5].z = 0;
  EXPECT_EQ(vertices_of_closed_edges(grid), (std::vector<char>{0, 1, 0, 0, 0, 1, 0, 0}));
  EXPECT_EQ(mean_plan_edge_m(grid.plan), 1);
}

}  // namespace
}  // namespace strataflow
