// Jobs that ask for hexahedra, as a user runs them: what cannot be extruded is refused by name and leaves nothing; a
// real model with a reverse fault is meshed on its own triangles.
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "support/command_line.h"

namespace strataflow {
namespace {

namespace fs = std::filesystem;

fs::path data_folder() {
  const char* folder = std::getenv("STRATAFLOW_DATA");
  return fs::absolute(folder ? fs::path(folder) : fs::path(STRATAFLOW_SOURCE_DIR) / ".." / "shared" / "data");
}

/// Runs a job of hexahedra on `input`, a line of [[input]], into `folder` / run.
support::CommandOutcome hexahedra(const fs::path& folder, const std::string& input, const std::string& options) {
  support::write_text(folder / "job.toml",
                      "[[input]]\n" + input + "\n[output]\nproducts = [\"hexes\"]\n[hex]\n" + options);
  return support::strataflow({"run", (folder / "job.toml").string(), "--out", (folder / "run").string(), "--no-cache"});
}

TEST(HexJobs, refuse_a_dome_by_name_and_leave_nothing) {
  const support::ScratchFolder scratch;
  const auto refused = hexahedra(scratch.path(), "model = \"D\"", "edge_length_m = 20.0\nlayers = 1\n");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("Diapir is an intrusion"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("drop_alignment = [\"Diapir\"]"), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(scratch.path() / "run"));
}

/// A box of 1000 × 600 × 400 m, and planes with y from 0 to 600 m between the ends of each line (x, z), as OBJ files.
std::string box_with_faults(const fs::path& folder, const std::vector<std::array<double, 4>>& lines) {
  std::string box, faults;
  for (const double z : {0.0, 400.0})
    for (const auto& [x, y] : {std::pair{0, 0}, {1000, 0}, {1000, 600}, {0, 600}})
      box += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
  box +=
      "g bottom\nf 1 3 2\nf 1 4 3\ng top\nf 5 6 7\nf 5 7 8\ng south\nf 1 2 6\nf 1 6 5\n"
      "g east\nf 2 3 7\nf 2 7 6\ng north\nf 3 4 8\nf 3 8 7\ng west\nf 4 1 5\nf 4 5 8\n";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto& [x0, z0, x1, z1] = lines[i];
    for (const auto& [x, y, z] : {std::array{x0, 0.0, z0}, {x0, 600.0, z0}, {x1, 600.0, z1}, {x1, 0.0, z1}})
      faults += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
    const auto corner = [&](std::size_t k) { return " " + std::to_string(4 * i + k); };
    faults += "g F" + std::to_string(i + 1) + "\nf" + corner(1) + corner(2) + corner(3) + "\nf" + corner(1) +
              corner(3) + corner(4) + "\n";
  }
  support::write_text(folder / "box.obj", box);
  support::write_text(folder / "faults.obj", faults);
  return "file = \"faults.obj\"\nrole = \"fault\"\n[[input]]\nfile = \"box.obj\"\nrole = \"boundary\"";
}

/// The refusal names the fault and the remedy, and the remedy works.
void expect_refused_until_dropped(const std::vector<std::array<double, 4>>& lines, const std::string& fault,
                                  const std::string& why) {
  const support::ScratchFolder scratch;
  const std::string input = box_with_faults(scratch.path(), lines), options = "edge_length_m = 100.0\nlayers = 2\n";
  const auto refused = hexahedra(scratch.path(), input, options);
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find(fault + " " + why), std::string::npos) << refused.err;
  const std::string remedy = "drop_alignment = [\"" + fault + "\"]";
  EXPECT_NE(refused.err.find(remedy), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(scratch.path() / "run"));
  const auto made = hexahedra(scratch.path(), input, options + remedy + "\n");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto audit =
      nlohmann::json::parse(support::read_text(scratch.path() / "run" / "report.json"))["hexes"]["audit"];
  EXPECT_GT(audit["cells"], 50);
  EXPECT_EQ(audit["inverted"], 0);
}

TEST(HexJobs, refuse_a_y_of_faults_by_name_and_mesh_it_without_the_branch) {
  expect_refused_until_dropped({{300, 400, 700, 0}, {800, 400, 500, 200}}, "F2", "ends downwards on F1");
}

TEST(HexJobs, refuse_a_nearly_horizontal_fault_by_name_and_mesh_the_model_without_it) {
  expect_refused_until_dropped({{0, 180, 1000, 220}}, "F1", "is nearly horizontal");
}

TEST(HexJobs, mesh_a_reverse_fault_on_the_triangles_of_its_model) {
  const fs::path file = data_folder() / "ringmesh-tiny" / "geomodel3d_only.ml";
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not there: set STRATAFLOW_DATA to the folder of the real models";
  const support::ScratchFolder scratch;
  const auto made = hexahedra(scratch.path(), "file = \"" + file.string() + "\"", "edge_length_m = 20.0\nlayers = 1\n");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto audit =
      nlohmann::json::parse(support::read_text(scratch.path() / "run" / "report.json"))["hexes"]["audit"];
  EXPECT_GT(audit["cells"], 20);
  EXPECT_EQ(audit["inverted"], 0);
  EXPECT_LT(audit["furthest_from_horizons_m"], 1e-6 * audit["diagonal_m"].get<double>());
  EXPECT_LT(audit["furthest_from_faults_m"], 2.0);  // its triangles are longer than the edges asked for
}

}  // namespace
}  // namespace strataflow
