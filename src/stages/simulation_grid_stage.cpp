#include "stages/simulation_grid_stage.h"

#include <algorithm>
#include <set>

#include "io/simulator/write_deck.h"
#include "io/simulator/write_grdecl.h"
#include "kernels/simulation_grid/build_simulation_grid.h"
#include "kernels/simulation_grid/index_fields.h"
#include "kernels/simulation_grid/place_wells.h"

namespace strataflow {

namespace {

GridLayout layout_named(const std::string& name) {
  if (name == "native") return GridLayout::native;
  if (name == "blocks") return GridLayout::blocks;
  return name == "unstructured" ? GridLayout::unstructured : GridLayout::automatic;
}

Failure unknown_name(const std::string& key, const std::string& name, const std::string& what) {
  return Failure{FailureCode::invalid_options, "hex." + key + " names '" + name + "', which is no " + what,
                 "use the names that `strataflow check` prints"};
}

/// Per region the unit it lies in, called by its roof; empty without cells.
std::vector<std::string> units_of(const HexGrid& hexes, const StratigraphicTets& layers) {
  std::vector<std::string> units(hexes.mesh.region_names.size());
  for (std::size_t cell = hexes.mesh.cell_count(); cell-- > 0;) {
    if (hexes.is_dead[cell]) continue;
    const auto roof = std::upper_bound(layers.level_w.begin(), layers.level_w.end(), hexes.cell_layer[cell]);
    units[static_cast<std::size_t>(hexes.mesh.cell_region[cell])] =
        layers.level_names[static_cast<std::size_t>(roof - layers.level_w.begin())];
  }
  return units;
}

/// A region's own value goes before that of its unit.
Result<std::vector<RegionRock>> rock_of(const std::vector<std::string>& regions, const std::vector<std::string>& units,
                                        const SimulationGridStageOptions& options) {
  std::vector<RegionRock> rock;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const auto value = [&](const std::map<std::string, double>& by_name, double otherwise) {
      auto found = by_name.find(regions[r]);
      if (found == by_name.end()) found = by_name.find(units[r]);
      return found == by_name.end() ? otherwise : found->second;
    };
    rock.push_back({regions[r], value(options.region_porosity, options.porosity),
                    value(options.region_permeability_md, options.permeability_md),
                    value(options.region_vertical_permeability_md, options.vertical_permeability_md)});
  }
  for (const auto& [key, by_name] : {std::pair{"region_porosity", &options.region_porosity},
                                     {"region_permeability_md", &options.region_permeability_md},
                                     {"region_vertical_permeability_md", &options.region_vertical_permeability_md}})
    for (const auto& [name, ignored] : *by_name)
      if (std::find(regions.begin(), regions.end(), name) == regions.end() &&
          std::find(units.begin(), units.end(), name) == units.end())
        return unknown_name(key, name, "region and no unit (called by the horizon that is its roof)");
  return rock;
}

/// Where the wells of the input stand: their first points, relative to the input's origin.
std::map<std::string, Vec3> places_of_wells(const InputData& input) {
  std::map<std::string, Vec3> places;
  for (const Polyline& line : input.lines)
    if (line.role == Role::well && !line.points.empty()) places.try_emplace(line.name, line.points.front());
  for (const PointSet& set : input.point_sets)
    if (set.role == Role::well)
      for (std::size_t p = 0; p < set.points.size(); ++p)
        places.try_emplace(set.points.size() == 1 ? set.name : set.name + " " + std::to_string(p + 1), set.points[p]);
  return places;
}

Result<std::vector<WellPlan>> wells_of(const SimulationGridStageOptions& options, const InputData& input,
                                       const std::vector<std::string>& regions, const std::vector<std::string>& units) {
  std::map<std::string, Vec3> places = places_of_wells(input);
  for (const auto& [name, x] : options.well_x_m) {
    const auto y = options.well_y_m.find(name);
    if (y == options.well_y_m.end())
      return Failure{FailureCode::invalid_options, "hex.well_x_m places well " + name + ", but hex.well_y_m does not",
                     "give it both coordinates"};
    places[name] = Vec3{x, y->second, 0} - input.surfaces.local_origin;
  }
  std::map<std::string, WellPlan> plans;
  for (const auto& [name, place] : places) plans[name] = {name, place.x, place.y, {}, false, 0, 0};
  for (const auto* by_name : {&options.well_pressure_bar, &options.well_injection_t_per_year, &options.well_y_m})
    for (const auto& [name, ignored] : *by_name)
      if (!plans.contains(name))
        return Failure{FailureCode::invalid_options, "[hex] names a well '" + name + "' that has no place",
                       "give it hex.well_x_m and hex.well_y_m, or an [[input]] with role = \"well\" and this name"};
  for (const std::string& text : options.well_regions) {
    const std::size_t in = text.find(" in ");
    const std::string name = text.substr(0, in);
    if (in == std::string::npos || !plans.contains(name))
      return Failure{FailureCode::invalid_options, "hex.well_regions: '" + text + "' names no well and region",
                     "write for instance \"INJ in H2\""};
    const std::string place = text.substr(in + 4);
    const std::size_t open_before = plans[name].regions.size();
    if (std::find(regions.begin(), regions.end(), place) == regions.end())
      for (std::size_t r = 0; r < regions.size(); ++r)
        if (units[r] == place) plans[name].regions.push_back(regions[r]);
    if (plans[name].regions.size() == open_before) plans[name].regions.push_back(place);  // a region, or no name
  }
  std::vector<WellPlan> wells;
  for (auto& [name, plan] : plans) {
    const auto pressure = options.well_pressure_bar.find(name);
    const auto injects = options.well_injection_t_per_year.find(name);
    plan.is_injector = injects != options.well_injection_t_per_year.end();
    plan.rate_t_per_year = plan.is_injector ? injects->second : 0;
    if (pressure == options.well_pressure_bar.end()) continue;  // a well that only shapes the plan
    plan.pressure_bar = pressure->second;
    wells.push_back(plan);
  }
  return wells;
}

}  // namespace

Result<SimulationFiles> MakeSimulationGrid::operator()(const SmoothedHexes& smoothed, const CheckedHexes& checked,
                                                       const LayeredSpace& space, const InputData& input,
                                                       StageContext& context) const {
  const HexGrid& hexes = smoothed.hexes.grid;
  const std::vector<std::string>& regions = hexes.mesh.region_names;
  const std::vector<std::string> units = units_of(hexes, space.layers);
  Result<std::vector<RegionRock>> rock = rock_of(regions, units, options);
  if (!rock) return rock.failure();
  std::vector<FaultTransmissibility> faults;
  for (const auto& [fault, multiplier] : options.fault_multiplier) faults.push_back({fault, multiplier});
  Result<SimulationGrid> grid =
      build_simulation_grid(hexes, *rock, faults, {layout_named(options.layout), options.pillar_tolerance_m});
  if (!grid) return grid.failure();
  Result<std::vector<WellPlan>> plans = wells_of(options, input, regions, units);
  if (!plans) return plans.failure();
  Result<std::vector<SimulationWell>> wells = place_wells(hexes, *grid, *plans);
  if (!wells) return wells.failure();
  SimulationFiles files;
  files.grid = std::move(*grid);
  files.wells = std::move(*wells);
  for (CellField& field : index_fields(hexes, files.grid)) {
    CellField& live = files.fields.emplace_back();
    live.name = std::move(field.name);
    for (const std::uint32_t cell : checked.live.grid_cell) live.values.push_back(field.values[cell]);
  }
  files.grdecl = write_grdecl(files.grid);
  if (!options.deck) {
    if (!files.wells.empty())
      context.warn("unused_wells", "wells have pressures, but hex.deck is false: no deck is written");
    return files;
  }
  files.regions = write_region_numbers(files.grid);
  DeckOptions deck;
  deck.fluid = options.deck_fluid == "co2_brine" ? DeckFluid::co2_brine : DeckFluid::gas_water;
  deck.initial_pressure_bar = options.deck_pressure_bar;
  deck.temperature_c = options.deck_temperature_c;
  deck.rock_compressibility_per_bar = options.deck_rock_compressibility_per_bar;
  deck.years = options.deck_years;
  Result<std::string> text = write_deck(files.grid, files.wells, "hexes.grdecl", "hexes_regions.inc", deck);
  if (!text) return text.failure();
  files.deck = std::move(*text);
  return files;
}

}  // namespace strataflow
