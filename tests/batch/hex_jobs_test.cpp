// Jobs that ask for hexahedra, as a user runs them: what cannot be extruded is refused by name and leaves nothing; a
// real model with a reverse fault is meshed on its own triangles.
#include <gtest/gtest.h>

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
  support::write_text(folder / "job.toml", "[[input]]\n" + input + "\n[output]\nproducts = [\"hexes\"]\n[hex]\n" + options);
  return support::strataflow(
      {"run", (folder / "job.toml").string(), "--out", (folder / "run").string(), "--no-cache"});
}

TEST(HexJobs, refuse_a_dome_by_name_and_leave_nothing) {
  const support::ScratchFolder scratch;
  const auto refused = hexahedra(scratch.path(), "model = \"D\"", "edge_length_m = 20.0\nlayers = 1\n");
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_NE(refused.err.find("Diapir is an intrusion"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("drop_alignment = [\"Diapir\"]"), std::string::npos) << refused.err;
  EXPECT_FALSE(fs::exists(scratch.path() / "run"));
}

TEST(HexJobs, mesh_a_reverse_fault_on_the_triangles_of_its_model) {
  const fs::path file = data_folder() / "ringmesh-tiny" / "geomodel3d_only.ml";
  if (!fs::exists(file)) GTEST_SKIP() << file << " is not there: set STRATAFLOW_DATA to the folder of the real models";
  const support::ScratchFolder scratch;
  const auto made =
      hexahedra(scratch.path(), "file = \"" + file.string() + "\"", "edge_length_m = 20.0\nlayers = 1\n");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const auto audit = nlohmann::json::parse(support::read_text(scratch.path() / "run" / "report.json"))["hexes"]["audit"];
  EXPECT_GT(audit["cells"], 20);
  EXPECT_EQ(audit["inverted"], 0);
  EXPECT_LT(audit["furthest_from_horizons_m"], 1e-6 * audit["diagonal_m"].get<double>());
  EXPECT_LT(audit["furthest_from_faults_m"], 2.0);  // its triangles are longer than the edges asked for
}

}  // namespace
}  // namespace strataflow
