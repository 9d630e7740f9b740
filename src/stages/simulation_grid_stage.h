#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "model/cell_field.h"
#include "model/input_data.h"
#include "model/simulation_grid.h"
#include "stages/extrude_stage.h"

namespace strataflow {

/// [hex]: what a simulator gets.
struct SimulationGridStageOptions {
  std::string layout = "automatic";
  std::optional<double> pillar_tolerance_m;
  double porosity = 0.2;
  double permeability_md = 100;
  double vertical_permeability_md = 10;
  std::map<std::string, double> region_porosity;
  std::map<std::string, double> region_permeability_md;
  std::map<std::string, double> region_vertical_permeability_md;
  std::map<std::string, double> fault_multiplier;
  bool deck = false;
  std::string deck_fluid = "co2_brine";
  double deck_years = 20;
  double deck_pressure_bar = 40;
  double deck_temperature_c = 40;
  double deck_rock_compressibility_per_bar = 1e-5;
  std::map<std::string, double> well_x_m;
  std::map<std::string, double> well_y_m;
  std::map<std::string, double> well_pressure_bar;
  std::map<std::string, double> well_injection_t_per_year;
  std::vector<std::string> well_regions;

  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(layout,
          OptionField{.name = "layout",
                      .description = "How columns get indices: native is one block of neighbours; unstructured gives "
                                     "each column pillars of its own and tells all lateral contacts; blocks packs "
                                     "rectangles; automatic is native where the plan allows it, else blocks or "
                                     "unstructured, whichever gives the smaller deck",
                      .words = {"automatic", "native", "blocks", "unstructured"}});
    visit(
        pillar_tolerance_m,
        OptionField{.name = "pillar_tolerance_m",
                    .description = "How far a corner may lie from the straight pillar of its column before the column "
                                   "is split; absent: 1 % of the mean edge",
                    .minimum = 0,
                    .exclusive_minimum = true});
    visit(porosity,
          OptionField{.name = "porosity", .description = "Of all regions not named", .minimum = 0, .maximum = 1});
    visit(permeability_md, OptionField{.name = "permeability_md",
                                       .description = "Along layers, of all regions not named, millidarcy",
                                       .minimum = 0});
    visit(vertical_permeability_md, OptionField{.name = "vertical_permeability_md",
                                                .description = "Across layers, of all regions not named, millidarcy",
                                                .minimum = 0});
    visit(region_porosity,
          OptionField{.name = "region_porosity",
                      .description = "Porosity of single regions, or of all in a unit, by name; a unit is called "
                                     "by the horizon that is its roof",
                      .minimum = 0,
                      .maximum = 1});
    visit(region_permeability_md,
          OptionField{.name = "region_permeability_md",
                      .description = "Permeability along layers of single regions or units, by name",
                      .minimum = 0});
    visit(region_vertical_permeability_md,
          OptionField{.name = "region_vertical_permeability_md",
                      .description = "Permeability across layers of single regions or units, by name",
                      .minimum = 0});
    visit(fault_multiplier,
          OptionField{.name = "fault_multiplier",
                      .description = "What of a flow passes faults, by name: { F1 = 0.001 }; 1 if not named",
                      .minimum = 0});
    visit(deck,
          OptionField{.name = "deck", .description = "Write a deck that OPM's flow runs: hexes.data beside the grid"});
    visit(deck_fluid,
          OptionField{.name = "deck_fluid",
                      .description = "co2_brine needs a simulator with CO2STORE; gas_water is an immiscible "
                                     "stand-in",
                      .words = {"co2_brine", "gas_water"}});
    visit(deck_years,
          OptionField{
              .name = "deck_years", .description = "How long the deck runs", .minimum = 0, .exclusive_minimum = true});
    visit(deck_pressure_bar, OptionField{.name = "deck_pressure_bar",
                                         .description = "Initial pressure at the highest cell",
                                         .minimum = 0,
                                         .exclusive_minimum = true});
    visit(deck_temperature_c, OptionField{.name = "deck_temperature_c",
                                          .description = "Temperature everywhere, degrees Celsius",
                                          .minimum = 0,
                                          .maximum = 200});
    visit(
        deck_rock_compressibility_per_bar,
        OptionField{.name = "deck_rock_compressibility_per_bar", .description = "Of the pores, per bar", .minimum = 0});
    visit(well_x_m, OptionField{.name = "well_x_m",
                                .description = "Where wells stand, by name, in the input's coordinates; wells of an "
                                               "[[input]] with role = \"well\" have their place from there"});
    visit(well_y_m, OptionField{.name = "well_y_m", .description = "The same"});
    visit(well_pressure_bar, OptionField{.name = "well_pressure_bar",
                                         .description = "Pressure in wells at their highest cell, by name: the most of "
                                                        "an injector, the least of a producer",
                                         .minimum = 0,
                                         .exclusive_minimum = true});
    visit(well_injection_t_per_year,
          OptionField{.name = "well_injection_t_per_year",
                      .description = "What wells inject, by name; wells that are not named here produce; 0: as much as "
                                     "the pressure lets",
                      .minimum = 0});
    visit(well_regions,
          OptionField{
              .name = "well_regions",
              .description = "Where wells are open, each \"INJ in H2\", a region or unit; everywhere if not named"});
  }
};

/// What simulators get: the grid with its connections, the wells, and the texts of their files.
struct SimulationFiles {
  SimulationGrid grid;
  std::vector<SimulationWell> wells;
  std::vector<CellField> fields;  ///< column, layer, i, j, k per cell of CheckedHexes
  std::string grdecl;             ///< hexes.grdecl
  std::string regions;            ///< hexes_regions.inc; empty without a deck
  std::string deck;               ///< hexes.data; empty without one
  template <class A>
  void archive(A& a) {
    a(grid, wells, fields, grdecl, regions, deck);
  }
};

/// The corner-point grid of the hexahedra (coudert2024 S22), and a deck that runs on it (S23).
struct MakeSimulationGrid {
  static constexpr std::string_view name = "simulation_grid";
  static constexpr int version = 2;
  SimulationGridStageOptions options;

  Result<SimulationFiles> operator()(const SmoothedHexes& hexes, const CheckedHexes& checked, const LayeredSpace& space,
                                     const InputData& input, StageContext& context) const;
};

}  // namespace strataflow
