#include "io/simulator/write_deck.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "io/simulator/write_grdecl.h"
#include "io/text/number_text.h"

namespace strataflow {

namespace {
/// CO2 at 1.01325 bar and 15.56 °C.
constexpr double gas_density_kg_m3 = 1.868;

/// "a b c" with blanks between.
template <class... Number>
std::string words(Number... numbers) {
  std::string text;
  ((text += ' ', append_number(text, numbers)), ...);
  return text;
}

std::optional<Failure> find_wrong_option(const SimulationGrid& grid, const std::vector<SimulationWell>& wells,
                                         const DeckOptions& options) {
  const auto wrong = [](const std::string& what) {
    return Failure{FailureCode::invalid_options, what, "correct the options of the deck"};
  };
  if (!(options.initial_pressure_bar > 0 && std::isfinite(options.initial_pressure_bar)))
    return wrong("initial_pressure_bar is not positive");
  if (!(options.temperature_c >= 0 && options.temperature_c <= 200))
    return wrong("temperature_c is not within 0 … 200");
  if (!(options.rock_compressibility_per_bar >= 0 && std::isfinite(options.rock_compressibility_per_bar)))
    return wrong("rock_compressibility_per_bar is negative");
  if (!(options.years > 0 && options.years <= 10000)) return wrong("years is not within 0 … 10000");
  for (const SimulationWell& well : wells) {
    if (well.cells.empty()) return wrong("well " + well.name + " meets no active cell");
    if (!(well.pressure_bar > 0 && std::isfinite(well.pressure_bar)))
      return wrong("well " + well.name + ": pressure_bar is not positive");
    if (!(well.rate_t_per_year >= 0 && std::isfinite(well.rate_t_per_year)))
      return wrong("well " + well.name + ": rate_t_per_year is negative");
  }
  if (std::none_of(grid.grid.is_active.begin(), grid.grid.is_active.end(), [](std::uint8_t a) { return a != 0; }))
    return Failure{FailureCode::invalid_input, "the grid has no active cell", "check the model"};
  return std::nullopt;
}

/// Depths of the highest and the lowest active corner.
std::array<double, 2> depth_range(const CornerPointGrid& grid) {
  std::array<double, 2> range{std::numeric_limits<double>::max(), std::numeric_limits<double>::lowest()};
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    if (!grid.is_active[cell]) continue;
    const auto ijk = grid.indices(cell);
    for (std::uint32_t c = 0; c < 8; ++c) {
      const double depth = -(grid.corner_z[grid.corner(ijk, c & 1, c >> 1 & 1, c >> 2)] + grid.local_origin.z);
      range = {std::min(range[0], depth), std::max(range[1], depth)};
    }
  }
  return range;
}

std::string runspec(const SimulationGrid& grid, const std::vector<SimulationWell>& wells, const DeckOptions& options) {
  const bool is_co2 = options.fluid == DeckFluid::co2_brine;
  std::size_t most_cells = 1;
  for (const SimulationWell& well : wells) most_cells = std::max(most_cells, well.cells.size());
  std::string text = "RUNSPEC\n\nTITLE\n " + options.title + "\n\nDIMENS\n" +
                     words(grid.grid.size[0], grid.grid.size[1], grid.grid.size[2]) + " /\n\nMETRIC\n\n";
  text += "-- brine is the oil of this deck\nOIL\nGAS\n";
  text += is_co2 ? "DISGAS\nCO2STORE\n\n" : "\n";
  text +=
      "START\n 1 JAN 2025 /\n\nTABDIMS\n" + words(grid.rock.size()) + " 1 50 50" + words(grid.rock.size()) + " /\n\n";
  text += "EQLDIMS\n 1 /\n\nREGDIMS\n" + words(grid.rock.size()) + " /\n\nWELLDIMS\n" +
          words(std::max<std::size_t>(wells.size(), 1), most_cells, 1, std::max<std::size_t>(wells.size(), 1)) +
          " /\n\n";
  if (const std::size_t records = fault_record_count(grid); records > 0)
    text += "FAULTDIM\n" + words(records) + " /\n\n";
  return text + "UNIFIN\nUNIFOUT\n\n";
}

std::string properties(const SimulationGrid& grid, const DeckOptions& options) {
  const bool is_co2 = options.fluid == DeckFluid::co2_brine;
  std::string text =
      "PROPS\n\nROCK\n" + words(options.initial_pressure_bar, options.rock_compressibility_per_bar) + " /\n\n";
  // Gas fills 0 … 0.8 of the pores, 0.2 of the brine stay.
  text += "SGOF\n";
  for (std::size_t r = 0; r < grid.rock.size(); ++r) {
    for (int step = 0; step <= 16; ++step) {
      const double gas = step / 16.0;
      text += words(0.8 * gas, gas * gas, (1 - gas) * (1 - gas), 0) + "\n";
    }
    text += "/\n";
  }
  if (is_co2) return text + "\n";
  text += "\nDENSITY\n 1000 1000" + words(gas_density_kg_m3) + " /\n\n";
  text += "-- water: pressure, volume factor, viscosity\nPVDO\n 1 1 0.65\n 401 0.982 0.65\n/\n\n";
  // CO2 at 40 °C, rounded: its density in kg/m³ and viscosity in cP by pressure in bar.
  static constexpr double table[][3] = {{1, 1.7, 0.0157},  {20, 36, 0.016},    {40, 80, 0.0166},
                                        {60, 149, 0.018},  {80, 278, 0.0224},  {100, 629, 0.048},
                                        {150, 780, 0.068}, {200, 840, 0.0785}, {400, 956, 0.11}};
  text += "-- carbon dioxide\nPVDG\n";
  for (const auto& row : table) text += words(row[0], gas_density_kg_m3 / row[1], row[2]) + "\n";
  return text + "/\n\n";
}

std::string solution(const SimulationGrid& grid, const DeckOptions& options) {
  const auto [top, bottom] = depth_range(grid.grid);
  const double margin = 1 + (bottom - top);
  const bool is_co2 = options.fluid == DeckFluid::co2_brine;
  // The contact with gas lies above everything.
  std::string text =
      "SOLUTION\n\nEQUIL\n" + words(top, options.initial_pressure_bar, bottom + margin, 0, top - margin, 0);
  if (!is_co2) return text + " /\n\n";
  text += " 1 /\n\n-- no gas in the brine\n";
  for (const auto& [keyword, value] : {std::pair{"RSVD", 0.0}, std::pair{"RTEMPVD", options.temperature_c}})
    text += std::string(keyword) + "\n" + words(top - margin, value) + "\n" + words(bottom + margin, value) + " /\n\n";
  return text;
}

std::string schedule(const std::vector<SimulationWell>& wells, const DeckOptions& options) {
  std::vector<std::string> given;
  for (const SimulationWell& well : wells) given.push_back(well.name);
  const auto names = simulator_names(given, 'W');
  std::string text = "SCHEDULE\n\nRPTRST\n BASIC=2 /\n\n";
  if (!wells.empty()) {
    std::string heads = "WELSPECS\n", cells = "COMPDAT\n", injectors, producers;
    for (std::size_t w = 0; w < wells.size(); ++w) {
      const SimulationWell& well = wells[w];
      const std::string name = " '" + names[w] + "'";
      heads += name + " 'WELLS'" + words(well.cells[0][0] + 1, well.cells[0][1] + 1) + " 1* " +
               (well.is_injector ? "GAS" : "OIL") + " /\n";
      for (std::size_t first = 0; first < well.cells.size();) {
        std::size_t last = first;
        while (last + 1 < well.cells.size() && well.cells[last + 1][0] == well.cells[first][0] &&
               well.cells[last + 1][1] == well.cells[first][1] && well.cells[last + 1][2] == well.cells[last][2] + 1)
          ++last;
        cells += name +
                 words(well.cells[first][0] + 1, well.cells[first][1] + 1, well.cells[first][2] + 1,
                       well.cells[last][2] + 1) +
                 " OPEN 2* 0.2 /\n";
        first = last + 1;
      }
      if (!well.is_injector)
        producers += name + " OPEN BHP 5*" + words(well.pressure_bar) + " /\n";
      else if (well.rate_t_per_year > 0)
        injectors += name + " GAS OPEN RATE" + words(well.rate_t_per_year * 1000 / gas_density_kg_m3 / 365.25) + " 1*" +
                     words(well.pressure_bar) + " /\n";
      else
        injectors += name + " GAS OPEN BHP 2*" + words(well.pressure_bar) + " /\n";
    }
    text += heads + "/\n\n" + cells + "/\n\n";
    if (!injectors.empty()) text += "WCONINJE\n" + injectors + "/\n\n";
    if (!producers.empty()) text += "WCONPROD\n" + producers + "/\n\n";
  }
  // Short steps first, then one report a year.
  text += "TSTEP\n";
  double left = options.years * 365.25;
  for (const double step : {1.0, 4.0, 10.0, 20.0, 55.25, 100.0, 175.0}) {
    if (!(left > 0)) break;
    text += words(std::min(step, left));
    left -= step;
  }
  if (const double years = std::floor(left / 365.25 + 1e-9); left > 0) {
    if (years > 0) text += words(static_cast<std::uint64_t>(years)) + "*365.25";
    if (left - years * 365.25 > 1e-6) text += words(left - years * 365.25);
  }
  return text + " /\n\nEND\n";
}
}  // namespace

Result<std::string> write_deck(const SimulationGrid& grid, const std::vector<SimulationWell>& wells,
                               const std::string& grid_file, const std::string& regions_file,
                               const DeckOptions& options) {
  if (const auto wrong = find_wrong_option(grid, wells, options)) return *wrong;
  const bool is_co2 = options.fluid == DeckFluid::co2_brine;
  std::string text = is_co2 ? "-- CO2 injected into brine (CO2STORE)\n"
                            : "-- gas injected into water: an immiscible stand-in for CO2 and brine\n";
  text += runspec(grid, wells, options);
  text += "GRID\n\nINIT\n\nINCLUDE\n '" + grid_file + "' /\n\n";
  text += properties(grid, options);
  text += "REGIONS\n\nINCLUDE\n '" + regions_file + "' /\n\n";
  text += solution(grid, options);
  text += "SUMMARY\n\nFPR\nFGIP\nFOIP\nFOIT\nFOPT\nFGIR\nFGIT\nFGPT\nRPR\n/\nWBHP\n/\nWGIR\n/\n\n";
  return text + schedule(wells, options);
}

}  // namespace strataflow
