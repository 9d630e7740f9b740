#include "io/simulator/write_grdecl.h"

#include <gtest/gtest.h>

#include "io/simulator/grdecl_text.h"
#include "io/simulator/sample_grids.h"

namespace strataflow {
namespace {

std::string values_text(const std::vector<double>& numbers, int decimals) {
  std::string text;
  {
    GrdeclValues values(text, "KEY");
    for (const double number : numbers) values.add_rounded(number, decimals);
  }
  return text;
}

TEST(GrdeclValues, repeat_equal_neighbours_by_a_count) {
  EXPECT_EQ(values_text({1, 1, 1, 2, 1}, 3), "KEY\n 3*1 2 1 /\n\n");
  EXPECT_EQ(values_text({}, 3), "KEY\n/\n\n");
}

TEST(GrdeclValues, round_to_digits_without_zeros_at_the_end) {
  EXPECT_EQ(values_text({0.12345, 1.5, -0.0001, 1e20, 300}, 2), "KEY\n 0.12 1.5 0 100000000000000000000 300 /\n\n");
  EXPECT_EQ(values_text({300}, 0), "KEY\n 300 /\n\n");
}

TEST(GrdeclValues, keep_lines_below_a_hundred_characters) {
  std::vector<double> numbers;
  for (int n = 0; n < 500; ++n) numbers.push_back(1000.125 * n);
  const std::string text = values_text(numbers, 3);
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    EXPECT_LE(end - begin, 102u);
}

TEST(WriteGrdecl, says_a_regular_grid_depth_down) {
  const std::string text = write_grdecl(support::regular_grid(1, 1, 2));
  EXPECT_NE(text.find("SPECGRID\n 1 1 2 1 F /\n"), std::string::npos) << text;
  EXPECT_NE(text.find("COORD\n 2*0 1000 2*0 1020 100 0 1000 100 0 1020 0 100 1000 0 100 1020"), std::string::npos)
      << text;
  EXPECT_NE(text.find("ZCORN\n 4*1000 8*1010 4*1020 /"), std::string::npos) << text;
  EXPECT_NE(text.find("ACTNUM\n 2*1 /"), std::string::npos);
  EXPECT_NE(text.find("PERMZ\n 2*10 /"), std::string::npos);
  EXPECT_EQ(text.find("NNC"), std::string::npos);
  EXPECT_EQ(text.find("FAULTS"), std::string::npos);
  EXPECT_EQ(text.find("PINCH"), std::string::npos);
}

TEST(WriteGrdecl, adds_the_local_origin) {
  SimulationGrid grid = support::regular_grid(1, 1, 1);
  grid.grid.local_origin = {461000, 5930000, 100};
  const std::string text = write_grdecl(grid);
  EXPECT_NE(text.find(" 461000 5930000 900 461000 5930000 910 461100"), std::string::npos) << text;
  EXPECT_NE(text.find("ZCORN\n 4*900 4*910 /"), std::string::npos) << text;
}

TEST(WriteGrdecl, merges_the_faces_of_a_fault_down_each_column) {
  SimulationGrid grid = support::regular_grid(2, 1, 4);
  grid.faults = {{"main fault (west)", 0.001}, {"F2", 1}};
  for (const std::uint32_t k : {0u, 1u, 3u}) grid.fault_faces.push_back({0, 2 * k, CellFace::i_high});
  EXPECT_EQ(fault_record_count(grid), 2u);
  const std::string text = write_grdecl(grid);
  EXPECT_NE(text.find("FAULTS\n 'F1' 1 1 1 1 1 2 'X' /\n 'F1' 1 1 1 1 4 4 'X' /\n/\n"), std::string::npos) << text;
  EXPECT_NE(text.find("MULTFLT\n 'F1' 0.001 / -- main fault (west)\n/\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("'F2'"), std::string::npos) << "a fault without faces has no multiplier";
}

TEST(WriteGrdecl, lists_connections_with_indices_from_one) {
  SimulationGrid grid = support::regular_grid(3, 1, 2);
  grid.connections = {{0, 5, no_index, 0, 1000, 0.125}};
  EXPECT_NE(write_grdecl(grid).find("NNC\n 1 1 1 3 1 2 0.125 /\n/\n"), std::string::npos);
}

TEST(WriteRegionNumbers, count_from_one_and_name_the_regions) {
  SimulationGrid grid = support::regular_grid(1, 1, 3);
  grid.rock.push_back({"cap"});
  grid.cell_region = {1, -1, 0};
  const std::string text = write_region_numbers(grid);
  EXPECT_NE(text.find("-- 2: cap\n"), std::string::npos);
  EXPECT_NE(text.find("FIPNUM\n 2 2*1 /"), std::string::npos) << text;
  EXPECT_NE(text.find("SATNUM\n 2 2*1 /"), std::string::npos) << text;
}

TEST(SimulatorNames, are_short_capital_and_different) {
  EXPECT_EQ(simulator_names({"F1", "f1", "a very long name", "9", "F4", ""}, 'F'),
            (std::vector<std::string>{"F1", "F2", "F3", "F5", "F4", "F6"}));
}

}  // namespace
}  // namespace strataflow
