// The bundled job of hexahedra, as a user runs it: OPM's flow takes the deck as it lies in the run folder.
#include <gtest/gtest.h>

#include "opm/run_flow.h"
#include "support/command_line.h"

namespace strataflow {
namespace {

TEST(HexesJob, writes_a_deck_that_flow_runs_to_the_end) {
  if (const std::string reason = support::why_without_opm(); !reason.empty()) GTEST_SKIP() << reason;
  const support::ScratchFolder scratch;
  const auto folder = scratch.path() / "hexes";
  const support::CommandOutcome made = support::strataflow(
      {"run", STRATAFLOW_SOURCE_DIR "/configs/examples/hexes.toml", "--out", folder.string(), "--no-cache"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  for (const char* file : {"hexes.vtu", "hexes_facets.vtp", "hexes_plan.vtp", "hexes.grdecl", "hexes_regions.inc"})
    EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;
  const auto flow = run_child_process(
      support::find_program("flow"),
      {(folder / "hexes.data").string(), "--output-dir=" + (scratch.path() / "flow").string()}, {}, 120);
  ASSERT_TRUE(flow && flow->is_success()) << (flow ? "flow exits with " + std::to_string(flow->exit_code) : describe(flow.failure()));
  const auto grid = run_child_process(support::find_program("grdecl2vtu"), {(folder / "hexes.grdecl").string()}, {}, 60);
  EXPECT_TRUE(grid && grid->is_success());
}

}  // namespace
}  // namespace strataflow
