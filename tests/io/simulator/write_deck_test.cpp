#include "io/simulator/write_deck.h"

#include <gtest/gtest.h>

#include <cmath>

#include "io/simulator/sample_grids.h"

namespace strataflow {
namespace {

const std::vector<SimulationWell> wells{{"INJ-1", true, 22500, 100, {{0, 0, 0}, {0, 0, 1}, {1, 0, 2}}},
                                        {"P", false, 0, 35, {{1, 0, 0}}}};

std::string deck(const std::vector<SimulationWell>& of_wells, const DeckOptions& options = {}) {
  const auto text = write_deck(support::regular_grid(2, 1, 3), of_wells, "a.grdecl", "a_regions.grdecl", options);
  EXPECT_TRUE(text) << describe(text.failure());
  return text ? *text : "";
}

TEST(WriteDeck, has_all_sections_in_order) {
  const std::string text = deck(wells);
  std::size_t at = 0;
  for (const char* section : {"RUNSPEC\n", "\nGRID\n", "'a.grdecl'", "\nPROPS\n", "\nREGIONS\n", "'a_regions.grdecl'",
                              "\nSOLUTION\n", "\nSUMMARY\n", "\nSCHEDULE\n", "\nEND\n"}) {
    const std::size_t found = text.find(section, at);
    ASSERT_NE(found, std::string::npos) << section;
    at = found;
  }
}

TEST(WriteDeck, groups_the_cells_of_a_well_by_columns) {
  const std::string text = deck(wells);
  EXPECT_NE(text.find(" 'INJ_1' 1 1 1 2 OPEN 2* 0.2 /\n 'INJ_1' 2 1 3 3 OPEN"), std::string::npos) << text;
  EXPECT_NE(text.find("WCONPROD\n 'P' OPEN BHP 5* 35 /"), std::string::npos);
  // 22 500 t a year of a gas of 1.868 kg/m³.
  EXPECT_NE(text.find(" 'INJ_1' GAS OPEN RATE 32977."), std::string::npos) << text;
}

TEST(WriteDeck, runs_for_the_years_asked_for) {
  EXPECT_NE(deck(wells).find("TSTEP\n 1 4 10 20 55.25 100 175 19*365.25 /"), std::string::npos) << deck(wells);
  DeckOptions options;
  options.years = 0.01;
  EXPECT_NE(deck(wells, options).find("TSTEP\n 1 2.6525 /"), std::string::npos);
  options.years = 1.5;
  EXPECT_NE(deck(wells, options).find(" 175 182.625 /"), std::string::npos);
}

TEST(WriteDeck, says_which_fluids_it_holds) {
  EXPECT_NE(deck(wells).find("\nCO2STORE\n"), std::string::npos);
  DeckOptions options;
  options.fluid = DeckFluid::gas_water;
  const std::string text = deck(wells, options);
  EXPECT_EQ(text.find("\nCO2STORE\n"), std::string::npos);
  EXPECT_NE(text.find("immiscible stand-in"), std::string::npos);
  EXPECT_NE(text.find("\nPVDG\n"), std::string::npos);
}

TEST(WriteDeck, refuses_options_out_of_their_domains) {
  const auto refused = [](std::vector<SimulationWell> of_wells, const DeckOptions& options, const std::string& words) {
    const auto text = write_deck(support::regular_grid(1, 1, 1), of_wells, "a", "b", options);
    ASSERT_FALSE(text) << words;
    EXPECT_EQ(text.failure().code, FailureCode::invalid_options);
    EXPECT_NE(text.failure().what.find(words), std::string::npos) << text.failure().what;
  };
  DeckOptions options;
  options.years = std::nan("");
  refused({}, options, "years");
  options = {};
  options.initial_pressure_bar = 0;
  refused({}, options, "initial_pressure_bar");
  refused({{"W", true, 0, 100, {}}}, {}, "well W");
  refused({{"W", true, 0, 0, {{0, 0, 0}}}}, {}, "pressure_bar");
  SimulationGrid empty = support::regular_grid(1, 1, 1);
  empty.grid.is_active[0] = 0;
  EXPECT_EQ(write_deck(empty, {}, "a", "b").failure().code, FailureCode::invalid_input);
}

}  // namespace
}  // namespace strataflow
