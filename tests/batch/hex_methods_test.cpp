// Jobs for the other kinds of hexahedra, as a user runs them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/command_line.h"

namespace strataflow {
namespace {

using support::read_text;
using support::ScratchFolder;
using support::write_text;
using testing::HasSubstr;

std::string job(const std::string& model, const std::string& hex, const std::string& more = "") {
  return "[[input]]\nmodel = \"" + model + "\"\nresolution_m = 150.0\n[output]\nproducts = [\"hexes\"]\n[hex]\n"
         "edge_length_m = 150.0\nlayers = 1\n" + hex + "\n" + more;
}

struct Outcome {
  support::CommandOutcome command;
  nlohmann::json hexes;
};
Outcome run(const ScratchFolder& scratch, const std::string& text) {
  write_text(scratch.path() / "job.toml", text);
  Outcome outcome;
  outcome.command = support::strataflow({"run", (scratch.path() / "job.toml").string(), "--no-cache"});
  const auto report = scratch.path() / "out/job/report.json";
  if (outcome.command.exit_code == 0) outcome.hexes = nlohmann::json::parse(read_text(report))["hexes"];
  return outcome;
}

TEST(HexMethods, a_sweep_over_them_is_compared_on_one_page) {
  const ScratchFolder scratch;
  write_text(scratch.path() / "job.toml",
             job("vertical-faults", "", "[sweep]\n\"hex.method\" = [\"conforming\", \"pillars\", \"stairs\"]\n"));
  const auto made = support::strataflow({"run", (scratch.path() / "job.toml").string(), "--no-cache"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const std::string page = read_text(scratch.path() / "out/comparison.html");
  EXPECT_THAT(page, HasSubstr("Hexahedra"));
  for (const char* method : {"conforming", "pillars", "stairs"}) {
    EXPECT_THAT(page, HasSubstr(std::string("<td>") + method + "</td>"));
    bool is_found = false;
    for (const auto& folder : std::filesystem::directory_iterator(scratch.path() / "out")) {
      if (!folder.is_directory() || folder.path().filename().string().find(method) == std::string::npos) continue;
      is_found = true;
      const auto hexes = nlohmann::json::parse(read_text(folder.path() / "report.json"))["hexes"];
      EXPECT_EQ(hexes["method"], method);
      EXPECT_EQ(hexes["inverted"], 0);
      EXPECT_EQ(hexes["nonconforming_faces"], 0);
      if (std::string(method) != "conforming") {
        EXPECT_EQ(hexes["simulation_grid"]["layout"], "native");
      }
      for (const char* file : {"hexes.vtu", "hexes_facets.vtp", "hexes_plan.vtp", "hexes.grdecl", "report.html"})
        EXPECT_TRUE(std::filesystem::exists(folder.path() / file)) << file;
    }
    EXPECT_TRUE(is_found) << method;
  }
}

TEST(HexMethods, what_only_conforming_grids_have_is_refused_before_any_work_with_exit_code_2) {
  const ScratchFolder scratch;
  const Outcome outcome = run(scratch, job("vertical-faults", "method = \"stairs\"\nrefine_edge_m = { F1 = 20.0 }\n"
                                                              "follow_horizon_lines = true",
                                           "[quad]\nfault_thickness_m = { F1 = 5.0 }"));
  EXPECT_EQ(outcome.command.exit_code, 2) << outcome.command.err;
  for (const char* key : {"refine_edge_m", "follow_horizon_lines", "fault_thickness_m"})
    EXPECT_THAT(outcome.command.err, HasSubstr(key));
}

TEST(HexMethods, edges_are_shorter_along_a_fault_where_the_job_says_so) {
  const ScratchFolder scratch;
  const Outcome plain = run(scratch, job("dipping-faults", ""));
  ASSERT_EQ(plain.command.exit_code, 0) << plain.command.err;
  const Outcome finer = run(scratch, job("dipping-faults", "refine_edge_m = { F1 = 50.0 }\nrefine_within_m = { F1 = 0.0 }"));
  ASSERT_EQ(finer.command.exit_code, 0) << finer.command.err;
  EXPECT_GT(finer.hexes["quads"], 2 * plain.hexes["quads"].get<int>());
  EXPECT_EQ(finer.hexes["inverted"], 0);
  EXPECT_GT(finer.hexes["min_scaled_jacobian"], 0.25);
  EXPECT_LT(finer.hexes["audit"]["furthest_from_faults_m"], 1e-6);
}

}  // namespace
}  // namespace strataflow
