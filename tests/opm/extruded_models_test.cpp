// Models with faults and an erosion, meshed, extruded and written: OPM's programs read them and flow runs to the end.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "kernels/hexes/extrude_hexes.h"
#include "kernels/hexes/tet_models.h"
#include "kernels/simulation_grid/build_simulation_grid.h"
#include "kernels/simulation_grid/place_wells.h"
#include "opm/run_flow.h"
#include "support/scratch_folder.h"

namespace strataflow {
namespace {

class OpmOnModels : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string reason = support::why_without_opm(); !reason.empty()) GTEST_SKIP() << reason;
  }

  /// Rock of ten millidarcies, all faults nearly closed, gas injected in one corner for a year.
  support::FlowRun run(const HexGrid& hexes, GridLayout layout, SimulationGridReport& report,
                       std::optional<double> pillar_tolerance_m = {}) {
    std::vector<RegionRock> rock;
    for (const std::string& name : hexes.mesh.region_names) rock.push_back({name, 0.25, 10, 1});
    std::vector<FaultTransmissibility> faults;
    for (const Entity& entity : hexes.mesh.entities)
      if (entity.role == Role::fault) faults.push_back({entity.name, 0.001});
    const auto grid = build_simulation_grid(hexes, rock, faults, {layout, pillar_tolerance_m});
    EXPECT_TRUE(grid) << describe(grid.failure());
    if (!grid) return {};
    Vec3 high;
    for (const Vec3& point : hexes.plan.points) high = {std::max(high.x, point.x), std::max(high.y, point.y), 0};
    const auto wells =
        place_wells(hexes, *grid,
                    {{"INJ", 350, 150, {}, true, 22500, 300}, {"PROD", high.x - 100, high.y - 100, {}, false, 0, 60}});
    EXPECT_TRUE(wells) << describe(wells.failure());
    if (!wells) return {};
    support::FlowRun result =
        support::run_flow(folder_.path(), hexes, *grid, *wells, {"", DeckFluid::gas_water, 100, 40, 1e-5, 1});
    EXPECT_TRUE(result.succeeded) << result.output;
    support::expect_readable(folder_.path(), *grid);
    if (result.succeeded) support::expect_mass_balance(result);
    report = grid->report;
    return result;
  }

  HexGrid upright_hexes(const ColumnModel& columns) {
    const auto hexes =
        extrude_hexes(support::upright(support::filled(columns, 130), {2, {}, {}}), support::plan_of(columns, 110));
    EXPECT_TRUE(hexes) << describe(hexes.failure());
    return hexes ? hexes->grid : HexGrid{};
  }

  support::ScratchFolder folder_;
};

TEST_F(OpmOnModels, one_offset_fault_passes_the_same_in_every_layout) {
  const HexGrid hexes = upright_hexes(*vertical_faults(1, false));
  SimulationGridReport native, unstructured;
  const auto a = run(hexes, GridLayout::native, native);
  const auto b = run(hexes, GridLayout::unstructured, unstructured);
  EXPECT_EQ(native.fault_connections, 0u);
  EXPECT_GT(unstructured.fault_connections, 0u);
  support::expect_same_pressure(a, b);
}

TEST_F(OpmOnModels, a_network_of_twelve_faults_that_cross_abut_and_die) {
  const HexGrid hexes = upright_hexes(*vertical_faults(12, true));
  SimulationGridReport native, unstructured;
  support::expect_same_pressure(run(hexes, GridLayout::native, native),
                                run(hexes, GridLayout::unstructured, unstructured));
}

TEST_F(OpmOnModels, an_erosion_with_dead_cells) {
  const HexGrid hexes = upright_hexes(*unconformity(false));
  SimulationGridReport report;
  run(hexes, GridLayout::automatic, report);
  EXPECT_EQ(report.layout, "native");
  EXPECT_GT(report.dead_cells, 0u);
}

TEST_F(OpmOnModels, a_listric_fault_in_columns_split_in_K) {
  const auto columns = listric_fault();
  const LayeredSpace space = support::layered(support::filled(*columns, 100), {{}, {3, {}, {}}, false, 600});
  const auto hexes = extrude_hexes(space, support::plan_in(space, *columns, 100));
  ASSERT_TRUE(hexes) << describe(hexes.failure());
  SimulationGridReport unstructured, blocks;
  const auto a = run(hexes->grid, GridLayout::unstructured, unstructured);
  const auto b = run(hexes->grid, GridLayout::blocks, blocks);
  EXPECT_GT(unstructured.vertical_connections, 0u);
  EXPECT_GT(blocks.occupancy_ratio, 0.5);
  EXPECT_LE(unstructured.largest_deviation_m, 0.02 * 100);
  support::expect_same_pressure(a, b, 5e-3);  // same connections, other numbers of cells: flow's way differs

  // Cut in single layers no corner moves: packed slabs, side by side in one layer of places, and single cells agree.
  const auto slabs = run(hexes->grid, GridLayout::automatic, blocks, 1e-6);
  EXPECT_EQ(blocks.layout, "blocks");
  EXPECT_LT(blocks.largest_deviation_m, 1e-6);
  EXPECT_GT(blocks.index_contacts, 0u);
  const auto apart = run(hexes->grid, GridLayout::unstructured, unstructured, 1e-6);
  EXPECT_LT(blocks.lateral_connections + blocks.vertical_connections,
            (unstructured.lateral_connections + unstructured.vertical_connections) / 2);
  support::expect_same_pressure(slabs, b);
  support::expect_same_pressure(apart, a);
  support::expect_same_pressure(slabs, apart, 5e-3);
}

}  // namespace
}  // namespace strataflow
