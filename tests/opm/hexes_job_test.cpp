// Jobs of hexahedra, as a user runs them: OPM's flow takes the deck as it lies in the run folder.
#include <gtest/gtest.h>

#include <fstream>

#include "opm/run_flow.h"
#include "support/command_line.h"

namespace strataflow {
namespace {

class HexesJob : public testing::Test {
 protected:
  void SetUp() override {
    if (const std::string reason = support::why_without_opm(); !reason.empty()) GTEST_SKIP() << reason;
  }

  void expect_runs(const std::filesystem::path& job) {
    const auto folder = scratch_.path() / "run";
    const support::CommandOutcome made =
        support::strataflow({"run", job.string(), "--out", folder.string(), "--no-cache"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    for (const char* file : {"hexes.vtu", "hexes_facets.vtp", "hexes_plan.vtp", "hexes.grdecl", "hexes_regions.inc"})
      EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
    const auto flow = run_child_process(
        support::find_program("flow"),
        {(folder / "hexes.data").string(), "--output-dir=" + (scratch_.path() / "flow").string()}, {}, 240);
    ASSERT_TRUE(flow && flow->is_success())
        << (flow ? "flow exits with " + std::to_string(flow->exit_code) : describe(flow.failure()));
    const auto grid =
        run_child_process(support::find_program("grdecl2vtu"), {(folder / "hexes.grdecl").string()}, {}, 60);
    EXPECT_TRUE(grid && grid->is_success());
  }

  /// The example with this line in its [hex] section.
  std::filesystem::path example_with(const std::string& name, const std::string& line) const {
    std::stringstream text;
    text << std::ifstream(STRATAFLOW_SOURCE_DIR "/configs/examples/" + name).rdbuf();
    std::string job = text.str();
    job.insert(job.find("[hex]\n") + 6, line + "\n");
    const auto path = scratch_.path() / name;
    std::ofstream(path) << job;
    return path;
  }

  support::ScratchFolder scratch_;
};

TEST_F(HexesJob, of_dipping_faults_runs_to_the_end) {
  expect_runs(STRATAFLOW_SOURCE_DIR "/configs/examples/hexes.toml");
}

TEST_F(HexesJob, of_dipping_faults_runs_on_a_classic_pillar_grid) {
  expect_runs(example_with("hexes.toml", "method = \"pillars\""));
}

TEST_F(HexesJob, of_dipping_faults_runs_on_a_stair_step_grid) {
  expect_runs(example_with("hexes.toml", "method = \"stairs\""));
}

TEST_F(HexesJob, of_coudert2024_table_2_1_runs_its_twenty_years) {
  expect_runs(STRATAFLOW_SOURCE_DIR "/configs/examples/co2_injection.toml");
}

}  // namespace
}  // namespace strataflow
