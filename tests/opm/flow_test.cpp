// OPM's programs are the judges: what our files mean is what they make of them.
#include <gtest/gtest.h>

#include "kernels/simulation_grid/build_simulation_grid.h"
#include "kernels/simulation_grid/place_wells.h"
#include "opm/run_flow.h"
#include "support/hex_grids.h"
#include "support/scratch_folder.h"

namespace strataflow {
namespace {

using support::expect_mass_balance;
using support::expect_readable;
using support::expect_same_pressure;
using support::run_flow;

const std::vector<RegionRock> sand{{"sand", 0.25, 10, 1}};
const DeckOptions two_years{"", DeckFluid::gas_water, 40, 40, 1e-5, 2};

class Opm : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string reason = support::why_without_opm(); !reason.empty()) GTEST_SKIP() << reason;
  }

  struct Case {
    SimulationGrid grid;
    support::FlowRun run;
  };

  /// Injects near one place and produces near another, for two years.
  Case run(const HexGrid& hexes, GridLayout layout, const Vec3& injector, const Vec3& producer,
           const std::vector<FaultTransmissibility>& faults = {}, const std::vector<RegionRock>& rock = sand) {
    Case result;
    auto grid = build_simulation_grid(hexes, rock, faults, {layout, {}});
    EXPECT_TRUE(grid) << describe(grid.failure());
    if (!grid) return result;
    const auto wells = place_wells(
        hexes, *grid,
        {{"INJ", injector.x, injector.y, {}, true, 22500, 100}, {"PROD", producer.x, producer.y, {}, false, 0, 35}});
    EXPECT_TRUE(wells) << describe(wells.failure());
    if (!wells) return result;
    result.run = run_flow(folder_.path(), hexes, *grid, *wells, two_years);
    result.grid = std::move(*grid);
    EXPECT_TRUE(result.run.succeeded) << result.run.output;
    if (!result.run.succeeded) return result;
    expect_mass_balance(result.run);
    expect_readable(folder_.path(), result.grid);
    return result;
  }

  support::ScratchFolder folder_;
};

TEST_F(Opm, finds_the_same_pressure_in_a_box_of_every_layout) {
  const HexGrid hexes = support::box_grid(4, 3, 3);
  const auto native = run(hexes, GridLayout::native, {20, 30, 0}, {350, 250, 0});
  const auto unstructured = run(hexes, GridLayout::unstructured, {20, 30, 0}, {350, 250, 0});
  EXPECT_EQ(unstructured.grid.connections.size(), 51u);
  expect_same_pressure(native.run, unstructured.run);
}

TEST_F(Opm, lets_flow_through_the_overlap_of_an_offset_fault_only_and_as_much_as_its_own_transmissibilities_would) {
  const HexGrid hexes = support::faulted_grid(4, 3, 4, 2, 15, 0.5);
  const auto native = run(hexes, GridLayout::native, {20, 30, 0}, {350, 250, 0}, {{"F1", 0.5}});
  const auto unstructured = run(hexes, GridLayout::unstructured, {20, 30, 0}, {350, 250, 0}, {{"F1", 0.5}});
  expect_same_pressure(native.run, unstructured.run);
  // OPM's own connections across the fault, those between cells of one K apart, are among ours.
  ASSERT_TRUE(native.run.init.count("TRANNNC"));
  std::vector<double> theirs = native.run.init.at("TRANNNC").back(), ours;
  for (const CellConnection& c : unstructured.grid.connections)
    if (c.fault != no_index) ours.push_back(c.transmissibility);
  std::sort(theirs.begin(), theirs.end());
  std::sort(ours.begin(), ours.end());
  for (const double t : theirs) {
    const auto near = std::lower_bound(ours.begin(), ours.end(), t * (1 - 1e-4));
    ASSERT_TRUE(near != ours.end() && *near <= t * (1 + 1e-4)) << t;
  }
  EXPECT_GE(theirs.size(), 9u);
}

TEST_F(Opm, keeps_pressure_on_its_side_where_an_offset_fault_leaves_no_overlap) {
  const HexGrid hexes = support::faulted_grid(4, 1, 1, 2, 15);
  const auto parted = run(hexes, GridLayout::unstructured, {50, 50, 0}, {350, 50, 0});
  EXPECT_EQ(parted.grid.report.fault_connections, 0u);
  ASSERT_FALSE(parted.run.pressure_bar.empty());
  for (std::size_t hex = 0; hex < hexes.mesh.cell_count(); ++hex) {
    const bool is_beyond = hexes.cell_column[hex] >= 2;
    EXPECT_NEAR(parted.run.pressure_bar[hex], is_beyond ? 35 : 100, 5) << hex;
  }
}

TEST_F(Opm, finds_the_same_pressure_around_a_singular_column_edge_in_packed_blocks) {
  const HexGrid hexes = support::hex_grid(support::plan_star(5, 3), 3, support::flat_level);
  const auto unstructured = run(hexes, GridLayout::unstructured, {20, 10, 0}, {100, 200, 0});
  const auto blocks = run(hexes, GridLayout::blocks, {20, 10, 0}, {100, 200, 0});
  EXPECT_EQ(blocks.grid.report.blocks, 5u);
  expect_same_pressure(unstructured.run, blocks.run);
}

TEST_F(Opm, runs_on_an_L_shaped_plan_in_every_layout) {
  const auto is_hole = [](std::uint32_t i, std::uint32_t j) { return i >= 2 && j >= 2; };
  const HexGrid hexes = support::hex_grid(support::plan_grid(4, 4, is_hole), 2, support::flat_level);
  const auto native = run(hexes, GridLayout::native, {350, 50, 0}, {50, 350, 0});
  expect_same_pressure(native.run, run(hexes, GridLayout::unstructured, {350, 50, 0}, {50, 350, 0}).run);
  expect_same_pressure(native.run, run(hexes, GridLayout::blocks, {350, 50, 0}, {50, 350, 0}).run);
}

TEST_F(Opm, crosses_the_dead_cells_of_an_unconformity) {
  // The middle of three layers dies out at x = 200; the rock above is ten times as permeable.
  const HexGrid hexes = support::hex_grid(support::plan_grid(4, 2), 3,
                                          [](std::uint32_t, const Vec3& corner, std::uint32_t level) {
                                            const double height =
                                                level < 2 ? 10.0 * level : 10.0 * level - std::min(10.0, corner.x / 20);
                                            return Vec3{corner.x, corner.y, -1000 + height};
                                          },
                                          {}, {0, 1, 2});
  const std::vector<RegionRock> rock{{"low", 0.25, 10, 1}, {"middle", 0.2, 5, 1}, {"high", 0.25, 100, 10}};
  const auto native = run(hexes, GridLayout::native, {20, 30, 0}, {350, 150, 0}, {}, rock);
  EXPECT_EQ(native.grid.report.dead_cells, 4u);
  const auto unstructured = run(hexes, GridLayout::unstructured, {20, 30, 0}, {350, 150, 0}, {}, rock);
  expect_same_pressure(native.run, unstructured.run);
  // Connected over the dead cells: the pressure above and below them is nearly the same.
  for (std::size_t hex = 0; hex + 2 < hexes.mesh.cell_count(); hex += 3)
    if (hexes.is_dead[hex + 1]) {
      EXPECT_EQ(native.run.pressure_bar[hex + 1], -1);
      EXPECT_NEAR(native.run.pressure_bar[hex], native.run.pressure_bar[hex + 2], 15);
    }
}

TEST_F(Opm, finds_the_same_pressure_in_bent_columns_split_in_K) {
  const HexGrid hexes =
      support::hex_grid(support::plan_grid(4, 2), 4, [](std::uint32_t, const Vec3& corner, std::uint32_t level) {
        return Vec3{corner.x + 0.4 * level * level, corner.y, -1000 + 10.0 * level};
      });
  const auto split = run(hexes, GridLayout::unstructured, {50, 50, 0}, {350, 150, 0});
  EXPECT_GT(split.grid.report.vertical_connections, 0u);
  const auto packed = run(hexes, GridLayout::automatic, {50, 50, 0}, {350, 150, 0});
  EXPECT_GT(packed.grid.report.vertical_connections, 0u);
  auto straight = build_simulation_grid(hexes, sand, {}, {GridLayout::native, 10.0});
  ASSERT_TRUE(straight) << describe(straight.failure());
  const auto wells =
      place_wells(hexes, *straight, {{"INJ", 50, 50, {}, true, 22500, 100}, {"PROD", 350, 150, {}, false, 0, 35}});
  ASSERT_TRUE(wells);
  const auto native = run_flow(folder_.path(), hexes, *straight, *wells, two_years);
  ASSERT_TRUE(native.succeeded) << native.output;
  expect_same_pressure(split.run, packed.run);
  expect_same_pressure(split.run, native, 5e-3);  // whose straight pillars leave corners 1.6 m off
}

TEST_F(Opm, runs_the_scenario_of_coudert2024_table_2_1_for_twenty_years) {
  // A cap of two layers over a reservoir of two, cut by a fault with 5 m of throw and multiplier 0.001. The gas comes
  // in at the base: flow 2022.10 loses brine that runs from cell to cell through an injector.
  HexGrid hexes = support::faulted_grid(6, 4, 4, 3, 5, 0.5);
  for (std::size_t cell = 0; cell < hexes.mesh.cell_count(); ++cell)
    hexes.mesh.cell_region[cell] = static_cast<std::int32_t>(std::min(hexes.cell_layer[cell], 2u));
  // 1e-14 m² are 10.13 mD.
  const std::vector<RegionRock> rock{
      {"base", 0.25, 10.1325, 1.01325}, {"reservoir", 0.25, 10.1325, 1.01325}, {"cap", 0.05, 1.01325e-4, 1.01325e-4}};
  for (const DeckFluid fluid : {DeckFluid::co2_brine, DeckFluid::gas_water}) {
    DeckOptions options;
    options.fluid = fluid;
    auto grid = build_simulation_grid(hexes, rock, {{"F1", 0.001}}, {GridLayout::unstructured, {}});
    ASSERT_TRUE(grid) << describe(grid.failure());
    const auto wells = place_wells(
        hexes, *grid, {{"INJ", 150, 150, {"base"}, true, 22500, 100}, {"PROD", 550, 350, {"reservoir"}, false, 0, 40}});
    ASSERT_TRUE(wells) << describe(wells.failure());
    const auto run = run_flow(folder_.path(), hexes, *grid, *wells, options);
    ASSERT_TRUE(run.succeeded) << run.output;
    if (fluid == DeckFluid::co2_brine)
      expect_mass_balance(run, 5e-3, 2e-4);
    else
      expect_mass_balance(run);
    EXPECT_NEAR(run.last.at("TIME"), 20 * 365.25, 1e-2);
    // The fault keeps the pressure on the injector's side.
    double near = 0, beyond = 0;
    for (std::size_t hex = 0; hex < hexes.mesh.cell_count(); ++hex)
      if (hexes.cell_layer[hex] < 2) (hexes.cell_column[hex] % 6 < 3 ? near : beyond) += run.pressure_bar[hex] / 24;
    EXPECT_GT(near, beyond + 20);
  }
}

}  // namespace
}  // namespace strataflow
