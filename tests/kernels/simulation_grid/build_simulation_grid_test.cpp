#include "kernels/simulation_grid/build_simulation_grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/archive.h"
#include "io/simulator/read_grdecl.h"
#include "io/simulator/write_grdecl.h"
#include "support/hex_grids.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

const std::vector<RegionRock> sand{{"sand", 0.25, 100, 10}};
using CellPair = std::pair<std::uint32_t, std::uint32_t>;

SimulationGrid build(const HexGrid& hexes, GridLayout layout, double tolerance_m = 1) {
  auto grid = build_simulation_grid(hexes, sand, {}, {layout, tolerance_m});
  EXPECT_TRUE(grid) << describe(grid.failure());
  return grid ? std::move(*grid) : SimulationGrid{};
}

/// Pairs of hexahedra with four vertices in common.
std::set<CellPair> pairs_sharing_a_face(const HexGrid& hexes) {
  std::map<std::array<std::uint32_t, 4>, std::vector<std::uint32_t>> users;
  static constexpr int faces[6][4] = {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6},
                                      {3, 0, 4, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}};
  for (std::uint32_t cell = 0; cell < hexes.mesh.cell_count(); ++cell)
    for (const auto& face : faces) {
      std::array<std::uint32_t, 4> key;
      for (int c = 0; c < 4; ++c) key[c] = hexes.mesh.cell_vertices[8 * cell + face[c]];
      std::sort(key.begin(), key.end());
      users[key].push_back(cell);
    }
  std::set<CellPair> pairs;
  for (const auto& [face, cells] : users)
    if (cells.size() == 2) pairs.insert({cells[0], cells[1]});
  return pairs;
}

/// coudert2024 R26, for grids without faults: neighbours in the mesh are neighbours by index or NNCs, never both, and
/// nothing else is.
void expect_same_neighbours(const HexGrid& hexes, const SimulationGrid& simulation) {
  const CornerPointGrid& grid = simulation.grid;
  std::set<CellPair> said;
  const auto say = [&](std::size_t a, std::size_t b) {
    const std::uint32_t p = simulation.hex_of_cell[a], q = simulation.hex_of_cell[b];
    EXPECT_TRUE(said.insert({std::min(p, q), std::max(p, q)}).second) << "cells " << p << " and " << q << " twice";
  };
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    if (!grid.is_active[cell]) continue;
    const auto [i, j, k] = grid.indices(cell);
    if (i + 1 < grid.size[0] && grid.is_active[grid.cell(i + 1, j, k)]) say(cell, grid.cell(i + 1, j, k));
    if (j + 1 < grid.size[1] && grid.is_active[grid.cell(i, j + 1, k)]) say(cell, grid.cell(i, j + 1, k));
    if (k + 1 < grid.size[2] && grid.is_active[grid.cell(i, j, k + 1)]) say(cell, grid.cell(i, j, k + 1));
  }
  for (const CellConnection& connection : simulation.connections) say(connection.cell_0, connection.cell_1);
  EXPECT_EQ(said, pairs_sharing_a_face(hexes));
}

/// Every hexahedron has one place, active unless dead, with its own corners.
void expect_same_cells(const HexGrid& hexes, const SimulationGrid& simulation, double tolerance_m) {
  std::vector<int> places(hexes.mesh.cell_count());
  for (std::size_t cell = 0; cell < simulation.hex_of_cell.size(); ++cell) {
    const std::uint32_t hex = simulation.hex_of_cell[cell];
    EXPECT_EQ(simulation.grid.is_active[cell] != 0, hex != no_index && !hexes.is_dead[hex]);
    if (hex == no_index) continue;
    ++places[hex];
    const auto corners = simulation.grid.corners_of(cell);
    for (int v = 0; v < 8; ++v) {
      double nearest = 1e300;
      for (int w = v & 4; w < (v & 4) + 4; ++w)
        nearest = std::min(nearest, length(corners[v] - hexes.mesh.points[hexes.mesh.cell_vertices[8 * hex + w]]));
      EXPECT_LE(nearest, tolerance_m);
    }
  }
  EXPECT_TRUE(std::all_of(places.begin(), places.end(), [](int n) { return n == 1; }));
}

TEST(SimulationGrid, of_a_box_is_native) {
  const HexGrid hexes = support::box_grid(4, 3, 2);
  const SimulationGrid grid = build(hexes, GridLayout::automatic);
  EXPECT_EQ(grid.report.layout, "native");
  EXPECT_EQ(grid.grid.size[0] * grid.grid.size[1], 12u);
  EXPECT_TRUE(grid.connections.empty());
  EXPECT_EQ(grid.report.occupancy_ratio, 1);
  EXPECT_EQ(grid.report.largest_volume_error_ratio, 0);
  expect_same_neighbours(hexes, grid);
  expect_same_cells(hexes, grid, 0);
}

TEST(SimulationGrid, unstructured_has_a_column_at_every_other_I) {
  const HexGrid hexes = support::box_grid(4, 3, 2);
  const SimulationGrid grid = build(hexes, GridLayout::unstructured);
  EXPECT_EQ(grid.grid.size, (std::array<std::uint32_t, 3>{23, 1, 2}));
  EXPECT_EQ(grid.connections.size(), 2u * 17);
  for (std::uint32_t i = 0; i < 23; ++i) EXPECT_EQ(grid.grid.is_active[i], i % 2 == 0);
  expect_same_neighbours(hexes, grid);
  expect_same_cells(hexes, grid, 1e-12);
}

TEST(SimulationGrid, knows_right_from_left_by_its_corner_pillars) {
  for (const HexGrid& hexes : {support::box_grid(1, 4, 1), support::box_grid(1, 1, 1), support::box_grid(5, 2, 1),
                               support::hex_grid(support::plan_star(5, 3), 1, support::flat_level)})
    for (const GridLayout layout : {GridLayout::automatic, GridLayout::blocks, GridLayout::unstructured}) {
      const CornerPointGrid grid = build(hexes, layout).grid;
      const Vec3 i = grid.pillars[2 * grid.pillar(grid.size[0], 0)] - grid.pillars[0];
      const Vec3 j = grid.pillars[2 * grid.pillar(0, grid.size[1])] - grid.pillars[0];
      EXPECT_GT(cross(i, j).z, 1000);
    }
}

TEST(SimulationGrid, falls_back_at_a_singular_vertex_and_says_why) {
  const HexGrid hexes = support::hex_grid(support::plan_star(5, 2), 2, support::flat_level);
  const SimulationGrid grid = build(hexes, GridLayout::automatic);
  EXPECT_EQ(grid.report.layout, "blocks");
  EXPECT_NE(grid.report.reason.find("singular"), std::string::npos);
  expect_same_neighbours(hexes, grid);
  const auto native = build_simulation_grid(hexes, sand, {}, {GridLayout::native, {}});
  ASSERT_FALSE(native);
  EXPECT_EQ(native.failure().code, FailureCode::unsupported);
}

TEST(SimulationGrid, of_blocks_hides_no_neighbours_between_them) {
  const auto is_hole = [](std::uint32_t i, std::uint32_t j) { return i >= 2 && j >= 3; };
  for (const QuadMesh& plan : {support::plan_star(3, 4), support::plan_star(5, 3), support::plan_grid(5, 5, is_hole)}) {
    const HexGrid hexes = support::hex_grid(plan, 2, support::flat_level);
    const SimulationGrid grid = build(hexes, GridLayout::blocks);
    EXPECT_GT(grid.report.blocks, 1u);
    EXPECT_GT(grid.report.occupancy_ratio, 0.4);
    expect_same_neighbours(hexes, grid);
    expect_same_cells(hexes, grid, 1e-9);
  }
}

TEST(SimulationGrid, written_and_read_back_has_the_same_neighbours) {
  const HexGrid hexes = support::hex_grid(support::plan_star(5, 3), 2, support::flat_level);
  for (const GridLayout layout : {GridLayout::blocks, GridLayout::unstructured}) {
    const SimulationGrid grid = build(hexes, layout);
    auto read = read_corner_points(write_grdecl(grid), "star.grdecl");
    ASSERT_TRUE(read) << describe(read.failure());
    read->hex_of_cell = grid.hex_of_cell;
    expect_same_neighbours(hexes, *read);
    expect_same_cells(hexes, *read, 1e-6);
  }
}

TEST(SimulationGrid, splits_bent_columns_in_K_and_joins_them_by_connections) {
  const HexGrid hexes =
      support::hex_grid(support::plan_grid(2, 2), 4, [](std::uint32_t, const Vec3& corner, std::uint32_t level) {
        return Vec3{corner.x + 5.0 * level * level, corner.y, 10.0 * level};
      });
  const SimulationGrid whole = build(hexes, GridLayout::automatic, 1000);
  EXPECT_EQ(whole.report.layout, "native");
  EXPECT_NEAR(whole.report.largest_deviation_m, 20, 1e-9);  // the chord of a parabola
  EXPECT_EQ(build(hexes, GridLayout::automatic, 6).report.layout, "blocks");
  const SimulationGrid split = build(hexes, GridLayout::unstructured, 6);
  EXPECT_EQ(split.grid.size[2], 2u);
  EXPECT_EQ(split.report.split_columns, 4u);
  EXPECT_EQ(split.report.vertical_connections, 4u);  // two layers and two
  EXPECT_NEAR(split.report.largest_deviation_m, 5, 1e-9);
  expect_same_neighbours(hexes, split);
  const SimulationGrid blocks = build(hexes, GridLayout::blocks, 6);
  EXPECT_EQ(blocks.report.blocks, 2u);
  expect_same_neighbours(hexes, blocks);
  const SimulationGrid exact = build(hexes, GridLayout::unstructured, 1e-3);
  EXPECT_LT(exact.report.largest_deviation_m, 1e-9);
  EXPECT_LT(exact.report.largest_volume_error_ratio, 1e-12);
}

TEST(SimulationGrid, of_bent_columns_is_about_as_large_as_its_cells_are_many) {
  const HexGrid hexes =
      support::hex_grid(support::plan_grid(6, 5), 12, [](std::uint32_t, const Vec3& corner, std::uint32_t level) {
        return Vec3{corner.x + 5.0 * level * level, corner.y, 10.0 * level};
      });
  for (const auto& [layout, most] : {std::pair{GridLayout::automatic, 1.5}, {GridLayout::unstructured, 2.0}}) {
    const SimulationGrid grid = build(hexes, layout, 6);
    EXPECT_LE(static_cast<double>(grid.grid.cell_count()), most * static_cast<double>(hexes.mesh.cell_count()));
    EXPECT_LE(grid.report.largest_deviation_m, 6);
    expect_same_neighbours(hexes, grid);
    expect_same_cells(hexes, grid, 6);
  }
}

TEST(SimulationGrid, puts_short_pieces_as_near_to_their_layers_as_the_box_lets) {
  // One bent column beside straight ones: cutting all would not pay, so the box is as high as the grid.
  const HexGrid hexes =
      support::hex_grid(support::plan_grid(8, 1), 4, [](std::uint32_t quad, const Vec3& corner, std::uint32_t level) {
        return Vec3{corner.x, corner.y - (quad == 7 && corner.y == 0 ? 5.0 * level * level : 0), 10.0 * level};
      });
  const SimulationGrid grid = build(hexes, GridLayout::unstructured, 6);
  ASSERT_EQ(grid.grid.size[2], 4u);
  EXPECT_EQ(grid.report.blocks, 9u);
  for (std::size_t cell = 0; cell < grid.grid.cell_count(); ++cell)
    if (grid.hex_of_cell[cell] != no_index)
      EXPECT_EQ(grid.grid.indices(cell)[2], 3 - hexes.cell_layer[grid.hex_of_cell[cell]]);
}

TEST(SimulationGrid, computes_the_transmissibility_of_boxes_by_hand) {
  const SimulationGrid grid = build(support::box_grid(2, 1, 1), GridLayout::unstructured);
  ASSERT_EQ(grid.connections.size(), 1u);
  EXPECT_NEAR(grid.connections[0].area_m2, 1000, 1e-9);
  EXPECT_NEAR(grid.connections[0].transmissibility, 0.008527017 * 100 * 1000 / 100, 1e-6);
}

TEST(SimulationGrid, puts_a_fault_multiplier_into_connections_or_says_it_by_faces) {
  const HexGrid hexes = support::faulted_grid(4, 2, 4, 2, 15);
  const SimulationGrid open = build(hexes, GridLayout::unstructured);
  const auto closed = build_simulation_grid(hexes, sand, {{"F1", 0.001}}, {GridLayout::unstructured, {}});
  ASSERT_TRUE(closed);
  EXPECT_EQ(open.report.fault_connections, 10u);
  for (std::size_t n = 0; n < open.connections.size(); ++n)
    EXPECT_NEAR(closed->connections[n].transmissibility,
                open.connections[n].transmissibility * (open.connections[n].fault == no_index ? 1 : 0.001), 1e-12);
  const SimulationGrid native = build(hexes, GridLayout::native);
  EXPECT_TRUE(native.connections.empty());
  // Three of four cells on the upper side meet the other side, in two rows.
  EXPECT_EQ(native.fault_faces.size(), 2u * 3);
}

TEST(SimulationGrid, leaves_dead_cells_inactive_between_live_ones) {
  const HexGrid hexes =
      support::hex_grid(support::plan_grid(3, 1), 3, [](std::uint32_t, const Vec3& corner, std::uint32_t level) {
        return Vec3{corner.x, corner.y, level == 2 && corner.x >= 100 ? 10.0 : 10.0 * level};
      });
  const SimulationGrid grid = build(hexes, GridLayout::automatic);
  EXPECT_EQ(grid.report.dead_cells, 2u);
  EXPECT_EQ(grid.report.active_cells, 7u);
  EXPECT_NE(write_grdecl(grid).find("\nPINCH\n"), std::string::npos);
}

TEST(SimulationGrid, refuses_what_it_cannot_honour) {
  const HexGrid hexes = support::faulted_grid(2, 1, 1, 1, 3);
  const auto code = [&](const auto& rock, const auto& faults, const SimulationGridOptions& options) {
    const auto grid = build_simulation_grid(hexes, rock, faults, options);
    return grid ? FailureCode::internal_error : grid.failure().code;
  };
  using Faults = std::vector<FaultTransmissibility>;
  EXPECT_EQ(code(sand, Faults{{"F9", 1}}, {}), FailureCode::invalid_options);
  EXPECT_EQ(code(sand, Faults{{"F1", -1}}, {}), FailureCode::invalid_options);
  EXPECT_EQ(code(sand, Faults{}, {GridLayout::automatic, 0.0}), FailureCode::invalid_options);
  EXPECT_EQ(code(std::vector<RegionRock>{{"sand", 1.5}}, Faults{}, {}), FailureCode::invalid_options);
  EXPECT_EQ(code(std::vector<RegionRock>{}, Faults{}, {}), FailureCode::invalid_input);
  EXPECT_EQ(code(sand, Faults{}, {GridLayout::unstructured, {}, 2}), FailureCode::unsupported);
  EXPECT_EQ(build_simulation_grid(HexGrid{}, sand, {}).failure().code, FailureCode::invalid_input);
}

TEST(SimulationGrid, is_the_same_on_every_schedule) {
  const HexGrid hexes = support::faulted_grid(12, 9, 5, 4, 17, 0.3);
  std::vector<std::byte> first;
  support::on_every_schedule([&](const char* schedule) {
    ArchiveWriter bytes;
    for (const GridLayout layout : {GridLayout::unstructured, GridLayout::blocks, GridLayout::automatic})
      for (const double tolerance_m : {1.0, 1e-3}) bytes(build(hexes, layout, tolerance_m));
    if (first.empty()) first = bytes.bytes();
    EXPECT_TRUE(first == bytes.bytes()) << schedule;
  });
}

}  // namespace
}  // namespace strataflow
