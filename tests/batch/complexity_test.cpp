// The product complexity, from the job file to the run folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "batch/report/complexity_json.h"
#include "batch/run/run_batch.h"
#include "io/vtk/read_vtk_xml.h"
#include "support/command_line.h"

namespace strataflow {
namespace {

using testing::HasSubstr;

std::string job_text(const std::string& complexity) {
  return "[[input]]\nmodel = \"A3\"\nresolution_m = 110.0\n[output]\nproducts = [\"complexity\"]\n[complexity]\n" +
         complexity;
}

TEST(ComplexityProduct, writes_its_block_its_page_and_its_map) {
  const support::ScratchFolder scratch;
  const Result<std::vector<Job>> jobs =
      read_jobs_from_text(job_text("edge_length_m = 20.0\ncells = [50, 400]\n"), "a.toml", scratch.path());
  ASSERT_TRUE(jobs) << describe(jobs.failure());
  const Result<std::vector<JobOutcome>> outcomes = run_batch(*jobs, {});
  ASSERT_TRUE(outcomes) << describe(outcomes.failure());
  ASSERT_FALSE(outcomes->front().failure) << describe(*outcomes->front().failure);
  const std::filesystem::path folder = outcomes->front().run_folder;

  const nlohmann::json block = nlohmann::json::parse(support::read_text(folder / "report.json"))["complexity"];
  EXPECT_EQ(block["counts"]["regions"], 4);
  EXPECT_EQ(block["counts"]["corners"], 12);
  EXPECT_EQ(block["neighbourhoods"], "voronoi");
  EXPECT_EQ(block["cells"][1]["n"], 400);
  EXPECT_EQ(block["geometric"]["edge_length_m"], 20.0);
  EXPECT_EQ(block["geometric"]["angle_deg"], 20.0);
  for (const char* type : {"regions", "surfaces", "lines"}) EXPECT_TRUE(block["geometric"][type].contains("total"));
  EXPECT_TRUE(block["size_variation"].contains("total"));
  ASSERT_EQ(block["cells"].size(), 2u);
  for (const char* key : {"n", "resolution_m", "q10", "q50", "q90", "max", "mean", "cv", "above_6"})
    EXPECT_TRUE(block["cells"][1].contains(key)) << key;
  EXPECT_EQ(block["faults"].size(), 2u);
  EXPECT_EQ(block["fault_network"]["dying"], 2);
  EXPECT_EQ(block["regions"].size(), 4u);

  const std::string map = support::read_text(folder / "complexity.vtu");
  const Result<InputData> read = read_vtk_xml(map, "complexity.vtu");
  ASSERT_TRUE(read) << describe(read.failure());
  EXPECT_GE(read->volume.cell_count(), 7 * block["cells"][1]["n"].get<std::size_t>());  // about eight voxels a cell
  for (const char* name : {"\"elements\"", "\"needed_edge_m\""}) EXPECT_THAT(map, HasSubstr(name));
  EXPECT_THAT(support::read_text(folder / "report.html"), HasSubstr("Complexity"));
}

TEST(ComplexityProduct, totals_are_the_sums_of_their_parts) {
  ComplexityReport report;
  report.counts = {.regions = 2, .surfaces = 11, .lines = 20, .corners = 12};
  report.geometric.elements = {{.type = ElementType::surface, .element = 4, .too_small = 1, .sharp = 0.5}};
  const nlohmann::ordered_json block = complexity_json(report);
  EXPECT_EQ(block["counts"]["total"], 45);
  EXPECT_EQ(block["geometric"]["surfaces"]["total"], 1.5);
  EXPECT_EQ(block["geometric"]["elements"][0]["type"], "surface");
  EXPECT_EQ(block["geometric"]["total"], 1.5);
}

TEST(ComplexityProduct, knows_its_neighbourhoods_and_says_so_before_any_work) {
  const Result<std::vector<Job>> jobs = read_jobs_from_text(job_text("neighbourhoods = \"hexagons\"\n"), "a.toml", "/");
  ASSERT_FALSE(jobs);
  EXPECT_THAT(jobs.failure().what, HasSubstr("neighbourhoods"));
}

}  // namespace
}  // namespace strataflow
