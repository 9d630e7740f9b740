// From tetrahedra to hexahedra and a simulator's files, stage by stage.
#include <gtest/gtest.h>

#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/topology/building/build_structural_model.h"
#include "stages/check_validity_stage.h"
#include "stages/extrude_stage.h"
#include "stages/plan_problem_stage.h"
#include "stages/simulation_grid_stage.h"
#include "stages/stratigraphic_function_stage.h"
#include "stages/tetrahedralize_stage.h"
#include "stages/verticalize_stage.h"
#include "support/made.h"

namespace strataflow {
namespace {

using support::made;

UprightModel upright(std::string_view name, double resolution_m = 150) {
  StageContext context("test", 1);
  const BuiltModel built = *build_structural_model(*generate_reference_model(name, {.resolution_m = resolution_m}));
  TetrahedralizeOptions tets;
  tets.radius_edge_ratio = 1.8;
  const VolumeMesh mesh = made(Tetrahedralize{tets}(built, *CheckValidity{}(built, context), context));
  return made(Verticalize{}(mesh, context));
}

struct Grid {
  LayeredSpace space;
  MeshedQuads plan;
  SmoothedHexes hexes;
};

Grid grid_of(const UprightModel& model, const InputData& input = {}, const LayerStageOptions& layers = {.layers = 2}) {
  StageContext context("test", 1);
  Grid grid;
  grid.space = made(FindStratigraphicFunction{layers}(model, context));
  const InputData lines = made(TakePlanLines{}(model, input, context));
  const FeatureMesh problem = made(PlanProblem{{.plan = {.edge_length_m = 150}}}(lines, context));
  const auto seamless = made(SeamlessMap{}(problem, made(ComputeFrameField{}(problem, context)), context));
  grid.plan = made(ExtractQuads{}(problem, made(Quantize{}(problem, seamless, context)), context));
  const ExtrudedHexes extruded = made(Extrude{}(grid.space, grid.plan, context));
  grid.hexes = made(SmoothHexes{}(grid.space, extruded, context));
  return grid;
}

Result<CheckedHexes> checked(const Grid& grid) {
  StageContext context;
  return CheckHexes{}(grid.hexes, grid.space, grid.plan, context);
}

const Grid& dipping() {
  static const Grid grid = grid_of(upright("dipping-faults"));
  return grid;
}
const Grid& erosion() {
  static const Grid grid = grid_of(upright("unconformity"));
  return grid;
}

Result<SimulationFiles> simulated(const Grid& grid, const SimulationGridStageOptions& options,
                                  const InputData& input = {}) {
  StageContext context;
  return MakeSimulationGrid{options}(grid.hexes, *checked(grid), grid.space, input, context);
}

TEST(HexStages, layers_follow_dipping_faults_with_all_cells_valid) {
  const CheckedHexes hexes = made(checked(dipping()));
  EXPECT_EQ(hexes.live.mesh.cell_count(), dipping().plan.mesh.quads.size() * dipping().space.layers.layer_count());
  EXPECT_EQ(hexes.quality.hexahedra, hexes.quality.cells);
  EXPECT_EQ(hexes.quality.inverted, 0u);
  EXPECT_EQ(hexes.quality.nonconforming_faces, 0u);
  EXPECT_GT(hexes.quality.min_scaled_jacobian, 0.3);
  EXPECT_GE(dipping().hexes.smoothing.min_after, dipping().hexes.smoothing.min_before);
}

TEST(HexStages, cells_that_an_erosion_closed_are_left_out_and_what_lies_around_them_meets) {
  const CheckedHexes hexes = made(checked(erosion()));
  EXPECT_GT(hexes.audit.dead, 0u);
  EXPECT_EQ(hexes.live.mesh.cell_count() + hexes.audit.dead, erosion().hexes.hexes.grid.mesh.cell_count());
  for (const MeshFacet& facet : hexes.live.mesh.facets) ASSERT_LT(facet.cell_0, hexes.live.mesh.cell_count());
}

TEST(HexStages, an_inverted_cell_is_refused) {
  Grid broken = dipping();
  VolumeMesh& mesh = broken.hexes.hexes.grid.mesh;
  const std::uint32_t* cell = mesh.cell_vertices.data();
  std::swap(mesh.points[cell[0]], mesh.points[cell[4]]);
  const Result<CheckedHexes> refused = checked(broken);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.failure().what.find("inverted"), std::string::npos) << refused.failure().what;
}

TEST(HexStages, a_unit_has_the_layers_asked_for) {
  const UprightModel model = upright("thin-layers", 100);
  StageContext context;
  const LayeredSpace plain = made(FindStratigraphicFunction{{.layers = 1}}(model, context));
  const LayeredSpace finer =
      made(FindStratigraphicFunction{{.layers = 1, .unit_layers = {{model.levels.names[1], 3.0}}}}(model, context));
  EXPECT_EQ(finer.layers.layer_count(), plain.layers.layer_count() + 2);
  EXPECT_FALSE((FindStratigraphicFunction{{.unit_layers = {{"nowhere", 2.0}}}}(model, context)));
  const auto half = FindStratigraphicFunction{{.unit_layers = {{model.levels.names[1], 2.5}}}}(model, context);
  ASSERT_FALSE(half);
  EXPECT_NE(half.failure().remedy.find("whole number"), std::string::npos);
}

TEST(HexStages, layers_may_follow_the_roof_of_a_unit) {
  const UprightModel model = upright("unconformity");
  StageContext context;
  const std::string unit = model.levels.names[1];
  const LayeredSpace even = made(FindStratigraphicFunction{{.layers = 3}}(model, context));
  const LayeredSpace parallel =
      made(FindStratigraphicFunction{{.layers = 3, .parallel_to_top = {unit}}}(model, context));
  EXPECT_EQ(even.layers.units[0].layout, LayerLayout::proportional);
  EXPECT_EQ(parallel.layers.units[0].layout, LayerLayout::parallel_to_top);
  EXPECT_EQ(parallel.layers.units[1].layout, LayerLayout::proportional);
  EXPECT_FALSE((FindStratigraphicFunction{{.parallel_to_base = {"nowhere"}}}(model, context)));
}

TEST(HexStages, wells_shape_the_plan_where_they_meet_the_top) {
  const UprightModel model = upright("dipping-faults");
  InputData input;
  input.point_sets = {{"P1", Role::well, {{160, 140, 0}}, {}}, {"far", Role::well, {{1e6, 0, 0}}, {}}};
  input.lines = {{"W", Role::well, {{1000, 500, 0}, {1000, 500, -900}}, false},
                 {"fence", Role::curve, {{0, 0, 0}, {1, 1, 0}}, false}};
  StageContext context;
  const InputData plan = made(TakePlanLines{}(model, input, context));
  EXPECT_EQ(plan.lines.size(), model.lines.size());
  ASSERT_EQ(plan.point_sets.size(), 2u);
  EXPECT_EQ(plan.point_sets[0].name, "W");
  EXPECT_EQ(plan.point_sets[1].name, "P1");
  EXPECT_LT(length(plan.point_sets[1].points[0] - Vec3{160, 140, 0}), 300);
  ASSERT_EQ(context.warnings().size(), 1u);
  EXPECT_EQ(context.warnings()[0].kind, "well_outside");
}

TEST(HexStages, an_unknown_entity_cannot_be_dropped) {
  StageContext context("test", 1);
  const BuiltModel built = *build_structural_model(*generate_reference_model("slab", {}));
  const VolumeMesh mesh = made(Tetrahedralize{}(built, *CheckValidity{}(built, context), context));
  const auto refused = Verticalize{{.drop_alignment = {"F99"}}}(mesh, context);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.failure().what.find("F99"), std::string::npos);
}

TEST(HexStages, a_deck_has_rock_by_region_multipliers_and_wells) {
  SimulationGridStageOptions options;
  const std::vector<std::string>& regions = dipping().hexes.hexes.grid.mesh.region_names;
  options.region_permeability_md = {{regions[0], 777.0}};
  options.fault_multiplier = {{"F1", 0.001}};
  options.deck = true;
  options.deck_fluid = "gas_water";
  options.well_x_m = {{"INJ", 160.0}};
  options.well_y_m = {{"INJ", 140.0}};
  options.well_pressure_bar = {{"INJ", 300.0}};
  options.well_injection_t_per_year = {{"INJ", 22500.0}};
  const SimulationFiles files = made(simulated(dipping(), options));
  ASSERT_EQ(files.wells.size(), 1u);
  EXPECT_TRUE(files.wells[0].is_injector);
  EXPECT_NE(files.grdecl.find("777"), std::string::npos);
  EXPECT_NE(files.deck.find("'hexes.grdecl'"), std::string::npos);
  EXPECT_NE(files.deck.find("WCONINJE"), std::string::npos);
  for (const CellField& field : files.fields) EXPECT_EQ(field.values.size(), checked(dipping())->live.grid_cell.size());
}

TEST(HexStages, a_well_of_the_input_stands_where_its_first_point_is) {
  InputData input;
  input.point_sets = {{"P1", Role::well, {{160, 140, 0}}, {}}};
  SimulationGridStageOptions options;
  options.deck = true;
  options.well_pressure_bar = {{"P1", 60.0}};
  const SimulationFiles files = made(simulated(dipping(), options, input));
  ASSERT_EQ(files.wells.size(), 1u);
  EXPECT_FALSE(files.wells[0].is_injector);
}

TEST(HexStages, rock_and_wells_may_be_named_by_unit_and_a_region_goes_before_its_unit) {
  SimulationGridStageOptions options;
  options.region_porosity = {{"Top", 0.05}, {"H1", 0.3}};
  const SimulationFiles by_unit = made(simulated(dipping(), options));
  std::size_t caps = 0, below = 0;
  std::string one_cap;
  for (const RegionRock& rock : by_unit.grid.rock) {
    caps += rock.porosity == 0.05;
    below += rock.porosity == 0.3;
    if (rock.porosity == 0.05) one_cap = rock.region;
  }
  EXPECT_GT(caps, 1u);  // faults part the unit into several regions
  EXPECT_GT(below, 1u);
  options.region_porosity[one_cap] = 0.5;
  for (const RegionRock& rock : made(simulated(dipping(), options)).grid.rock)
    EXPECT_EQ(rock.porosity == 0.5, rock.region == one_cap) << rock.region;

  options = {};
  options.well_x_m = {{"W", 300}};
  options.well_y_m = {{"W", 300}};
  options.well_pressure_bar = {{"W", 60}};
  const std::size_t everywhere = made(simulated(dipping(), options)).wells.at(0).cells.size();
  options.well_regions = {"W in Top"};
  const std::size_t in_cap = made(simulated(dipping(), options)).wells.at(0).cells.size();
  EXPECT_GT(in_cap, 0u);
  EXPECT_LT(in_cap, everywhere);
}

TEST(HexStages, names_that_are_nothing_are_told) {
  const auto what_of = [](const SimulationGridStageOptions& options) {
    const auto refused = simulated(dipping(), options);
    return refused ? std::string() : refused.failure().what;
  };
  SimulationGridStageOptions options;
  options.region_porosity = {{"nowhere", 0.1}};
  EXPECT_NE(what_of(options).find("region_porosity names 'nowhere'"), std::string::npos);
  options = {};
  options.fault_multiplier = {{"F99", 0.1}};
  EXPECT_NE(what_of(options).find("F99"), std::string::npos);
  options = {};
  options.well_pressure_bar = {{"W9", 60.0}};
  EXPECT_NE(what_of(options).find("'W9' that has no place"), std::string::npos);
  options = {};
  options.well_x_m = {{"W9", 60.0}};
  EXPECT_NE(what_of(options).find("well_y_m does not"), std::string::npos);
  options = {};
  options.well_regions = {"W9 somewhere"};
  EXPECT_NE(what_of(options).find("well_regions"), std::string::npos);
}

}  // namespace
}  // namespace strataflow
