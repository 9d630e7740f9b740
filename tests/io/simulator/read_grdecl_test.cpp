#include "io/simulator/read_grdecl.h"

#include "io/mesh_damage.h"
#include "io/simulator/sample_grids.h"
#include "io/simulator/write_grdecl.h"

namespace strataflow {
namespace {
using namespace support;

const std::string two_cells =
    "-- a comment\nSPECGRID\n 2 1 1 1 F /\n\nPORO\n 2*0.25 /\nCOORD\n"
    " 0 0 1000 0 0 1010 100 0 1000 100 0 1010 200 0 1000 200 0 1010 -- first row\n"
    " 0 100 1000 0 100 1010 100 100 1000 100 100 1010 200 100 1000 200 100 1010/\n"
    "ZCORN\n 8*1000\n 8*1010 /\nACTNUM\n 1 1 /\nNNC\n 1 1 1 2 1 1 0.5 / why not\n/\n";

TEST(ReadGrdecl, reads_cells_with_z_up) {
  const InputData input = read_whole(read_grdecl, two_cells, "a.grdecl");
  ASSERT_EQ(input.volume.cell_count(), 2u);
  EXPECT_EQ(input.volume.points.size(), 12u);
  EXPECT_EQ(input.volume.points[0], (Vec3{0, 0, -1010}));
}

TEST(ReadGrdecl, reads_connections_and_takes_cells_without_actnum_as_active) {
  const auto grid = read_corner_points(replaced(two_cells, "ACTNUM\n 1 1 /\n", ""), "a.grdecl");
  ASSERT_TRUE(grid) << describe(grid.failure());
  EXPECT_EQ(grid->grid.is_active, (std::vector<std::uint8_t>{1, 1}));
  ASSERT_EQ(grid->connections.size(), 1u);
  EXPECT_EQ(grid->connections[0].cell_1, 1u);
  EXPECT_EQ(grid->connections[0].transmissibility, 0.5);
}

TEST(ReadGrdecl, honours_units_and_map_axes) {
  const InputData feet = read_whole(read_grdecl, "GRIDUNIT\n 'FEET' /\n" + two_cells, "a.grdecl");
  EXPECT_NEAR(feet.volume.points[0].z, -1010 * 0.3048, 1e-9);
  const InputData turned = read_whole(read_grdecl, "MAPAXES\n 5 11 5 10 6 10 /\n" + two_cells, "a.grdecl");
  EXPECT_EQ(turned.volume.points[0], (Vec3{5, 10, -1010}));
}

TEST(ReadGrdecl, reads_what_we_write_bit_for_bit_where_numbers_are_short) {
  SimulationGrid grid = regular_grid(3, 2, 2);
  grid.grid.is_active[4] = 0;
  grid.connections = {{0, 7, no_index, 0, 0, 0.125}};
  const auto read = read_corner_points(write_grdecl(grid), "a.grdecl");
  ASSERT_TRUE(read) << describe(read.failure());
  EXPECT_EQ(read->grid.pillars, grid.grid.pillars);
  EXPECT_EQ(read->grid.corner_z, grid.grid.corner_z);
  EXPECT_EQ(read->grid.is_active, grid.grid.is_active);
  ASSERT_EQ(read->connections.size(), 1u);
  EXPECT_EQ(read->connections[0].cell_1, 7u);
}

TEST(ReadGrdecl, names_the_line_of_what_is_wrong) {
  const auto wrong = [](const std::string& from, const std::string& to, const std::string& words) {
    expect_malformed(read_grdecl(replaced(two_cells, from, to), "a.grdecl"), words, "a.grdecl");
  };
  wrong("8*1000", "7*1000", "ZCORN has 15 values, not 16");
  wrong("8*1000", "90000000000*1000", "ZCORN has more than 16 values");
  wrong("8*1000", "x*1000", "expected a number, found 'x*1000'");
  wrong("8*1000", "8*nan", "expected a number");
  wrong("2 1 1 1 F", "2 0 1 1 F", "three sizes");
  wrong("2 1 1 1 F", "100000 100000 1 1 F", "more cells than this file can hold");
  wrong("SPECGRID\n 2 1 1 1 F /\n", "", "before SPECGRID");
  wrong("ZCORN\n 8*1000\n 8*1010 /\n", "", "there is no ZCORN");
  wrong("ACTNUM\n 1 1 /", "SPECGRID\n 1 1 1 /", "said again");
  wrong("1 1 1 2 1 1 0.5", "1 1 1 3 1 1 0.5", "NNC: a cell is not in the grid");
  wrong("1 1 1 2 1 1 0.5", "1 1 1 2 1 1", "NNC: expected a transmissibility");
  const auto include = read_grdecl("INCLUDE\n 'b' /\n" + two_cells, "a.grdecl");
  ASSERT_FALSE(include);
  EXPECT_EQ(include.failure().code, FailureCode::unsupported);
}

TEST(ReadGrdecl, survives_damage) {
  expect_truncation_is_named(read_grdecl, two_cells, "a.grdecl", true);
  expect_damage_is_survived(read_grdecl, two_cells, "a.grdecl");
}

TEST(ReadGrdecl, reads_grids_of_others) {
  const auto count = [](const std::string& name) {
    return read_whole(read_grdecl, text_of(shared_data() / name), name).volume;
  };
  if (!std::filesystem::exists(shared_data() / "grids")) GTEST_SKIP() << "there is no " << shared_data();
  EXPECT_EQ(count("grids/SPE9.GRDECL").cell_count(), 24u * 25 * 15);
  const VolumeMesh faulted = count("gocad-formats/Simple20x20x5_Fault.grdecl");
  EXPECT_EQ(faulted.cell_count(), 2000u);
  EXPECT_EQ(faulted.points.size(), 21u * 6 * 22);  // the fault has two sides
  EXPECT_EQ(count("gocad-formats/EclipseGridTest.grdecl").points.size(), 60u);
}

}  // namespace
}  // namespace strataflow
