#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "base/child_process.h"
#include "io/simulator/write_deck.h"
#include "io/simulator/write_grdecl.h"
#include "model/hex_grid.h"

namespace strataflow::support {

/// The program in PATH, or an empty path.
inline std::filesystem::path find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::stringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (std::filesystem::exists(std::filesystem::path(folder) / name)) return std::filesystem::path(folder) / name;
  return {};
}

/// Why tests that need OPM's programs cannot run; empty if they can.
inline std::string why_without_opm() {
  if (const char* without = std::getenv("STRATAFLOW_WITHOUT_OPM"); without && std::string(without) != "0")
    return "STRATAFLOW_WITHOUT_OPM is set";
  if (find_program("flow").empty() || find_program("grdecl2vtu").empty())
    return "OPM is not installed: run 'tools/install_dependencies opm'";
  return {};
}

using OutputArrays = std::map<std::string, std::vector<std::vector<double>>>;

/// The arrays of a formatted Eclipse file by keyword, those of one keyword in the order of the file. Words become 0.
inline OutputArrays read_formatted_output(const std::filesystem::path& file,
                                          std::vector<std::string>* words = nullptr) {
  std::stringstream all;
  all << std::ifstream(file).rdbuf();
  const std::string text = all.str();
  std::size_t at = 0;
  const auto quoted = [&] {
    at = std::min(text.find('\'', at), text.size());
    const std::size_t end = std::min(text.find('\'', std::min(at + 1, text.size())), text.size());
    std::string word = at < text.size() ? text.substr(at + 1, end - at - 1) : "";
    at = std::min(end + 1, text.size());
    word.erase(word.find_last_not_of(' ') + 1);
    return word;
  };
  OutputArrays arrays;
  while (text.find('\'', at) != std::string::npos) {
    const std::string keyword = quoted();
    char* end = nullptr;
    const auto count = static_cast<std::size_t>(std::strtoul(text.c_str() + at, &end, 10));
    at = static_cast<std::size_t>(end - text.c_str());
    const std::string type = quoted();
    std::vector<double> values;
    for (std::size_t n = 0; n < count && at < text.size(); ++n) {
      if (type == "CHAR" || type[0] == 'C') {
        const std::string word = quoted();
        if (words && keyword == "KEYWORDS") words->push_back(word);
        values.push_back(0);
        continue;
      }
      at = std::min(text.find_first_not_of(" \n", at), text.size());
      const std::size_t stop = std::min(text.find_first_of(" \n", at), text.size());
      std::string word = text.substr(at, stop - at);
      std::replace(word.begin(), word.end(), 'D', 'E');
      values.push_back(type == "LOGI" ? word == "T" : std::strtod(word.c_str(), nullptr));
      at = stop;
    }
    arrays[keyword].push_back(std::move(values));
  }
  return arrays;
}

/// What OPM's flow made of a deck.
struct FlowRun {
  bool succeeded = false;
  std::string output;  ///< what it printed
  OutputArrays restart, init;
  std::map<std::string, double> first, last;  ///< vectors of the summary at its ends; wells share names

  /// Per hexahedron; −1 for dead ones.
  std::vector<double> pressure_bar;
};

/// Writes grid, regions and deck to the folder and runs flow on them.
inline FlowRun run_flow(const std::filesystem::path& folder, const HexGrid& hexes, const SimulationGrid& grid,
                        const std::vector<SimulationWell>& wells, const DeckOptions& options = {}) {
  FlowRun run;
  const auto deck = write_deck(grid, wells, "model.grdecl", "model_regions.grdecl", options);
  if (!deck) {
    run.output = describe(deck.failure());
    return run;
  }
  std::string text = *deck;
  text.replace(text.find("UNIFOUT"), 7, "UNIFOUT\nFMTOUT");
  std::ofstream(folder / "MODEL.DATA") << text;
  std::ofstream(folder / "model.grdecl") << write_grdecl(grid);
  std::ofstream(folder / "model_regions.grdecl") << write_region_numbers(grid);
  const auto outcome = run_child_process(find_program("flow"),
                                         {(folder / "MODEL.DATA").string(), "--output-dir=" + folder.string(),
                                          "--threads-per-process=1", "--tolerance-mb=1e-9"},
                                         {}, 300);
  if (!outcome) return run;
  run.succeeded = outcome->is_success();
  for (const std::byte b : outcome->output) run.output += static_cast<char>(b);
  if (run.output.size() > 2000) run.output.erase(0, run.output.size() - 2000);
  run.restart = read_formatted_output(folder / "MODEL.FUNRST");
  run.init = read_formatted_output(folder / "MODEL.FINIT");
  std::vector<std::string> vectors;
  read_formatted_output(folder / "MODEL.FSMSPEC", &vectors);
  const auto summary = read_formatted_output(folder / "MODEL.FUNSMRY");
  if (const auto found = summary.find("PARAMS"); found != summary.end())
    for (std::size_t v = 0; v < vectors.size(); ++v) {
      run.first[vectors[v]] = found->second.front().at(v);
      run.last[vectors[v]] = found->second.back().at(v);
    }
  if (const auto found = run.restart.find("PRESSURE"); found != run.restart.end()) {
    run.pressure_bar.assign(hexes.mesh.cell_count(), -1);
    std::size_t active = 0;
    for (std::size_t cell = 0; cell < grid.hex_of_cell.size(); ++cell)
      if (grid.grid.is_active[cell]) run.pressure_bar[grid.hex_of_cell[cell]] = found->second.back().at(active++);
  }
  return run;
}

/// What came in minus what went out is what there is more; volumes at the surface, in single precision. With CO2STORE
/// flow 2022.10 loses some, whatever its tolerances.
inline void expect_mass_balance(const FlowRun& run, double of_wells = 1e-4, double of_all = 2e-6) {
  for (const auto& [in_place, in, out] : {std::array{"FGIP", "FGIT", "FGPT"}, std::array{"FOIP", "FOIT", "FOPT"}}) {
    const double change = run.last.at(in_place) - run.first.at(in_place);
    const double wells = run.last.at(in) - run.last.at(out) - (run.first.at(in) - run.first.at(out));
    EXPECT_NEAR(change, wells, of_wells * std::abs(wells) + of_all * std::abs(run.last.at(in_place))) << in_place;
    EXPECT_NE(wells, 0) << in_place;
  }
}

/// grdecl2vtu makes a file with all active cells of the grid alone.
inline void expect_readable(const std::filesystem::path& folder, const SimulationGrid& grid) {
  const auto outcome = run_child_process(find_program("grdecl2vtu"), {(folder / "model.grdecl").string()}, {}, 60);
  ASSERT_TRUE(outcome && outcome->is_success());
  std::stringstream text;
  text << std::ifstream(folder / "model.vtu").rdbuf();
  const std::string expected = "NumberOfCells=\"" + std::to_string(grid.report.active_cells) + "\"";
  EXPECT_NE(text.str().find(expected), std::string::npos) << expected;
}

inline void expect_same_pressure(const FlowRun& a, const FlowRun& b, double ratio = 1e-3) {
  ASSERT_FALSE(a.pressure_bar.empty());
  ASSERT_EQ(a.pressure_bar.size(), b.pressure_bar.size());
  double largest = 0;
  for (std::size_t n = 0; n < a.pressure_bar.size(); ++n)
    largest = std::max(largest, std::abs(a.pressure_bar[n] - b.pressure_bar[n]) / std::abs(a.pressure_bar[n]));
  EXPECT_LT(largest, ratio);
}

}  // namespace strataflow::support
