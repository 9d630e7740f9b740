#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "batch/check_model.h"
#include "batch/convert.h"
#include "batch/diff_runs.h"
#include "batch/program_version.h"
#include "batch/report/html_page.h"
#include "batch/report/report_html.h"
#include "batch/report/report_json.h"
#include "batch/run/run_files.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/validity/check_validity.h"
#include "support/command_line.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

using support::write_text;
using testing::HasSubstr;

JobReport failed_report(const Job& job) {
  JobReport report;
  report.job = &job;
  report.stages.push_back(
      {"read/a.ml", "read", 1, {NodeStatus::failed, std::nullopt, {{"odd", "line 3"}}, std::nullopt}, {}});
  report.error = Failure{FailureCode::malformed_file, "a.ml:3: no \"number\"", "look"};
  return report;
}

TEST(Report, of_a_failure_says_what_why_and_what_to_do) {
  Job job;
  job.header.name = "j";
  const nlohmann::json json = nlohmann::json::parse(report_json(failed_report(job)));
  EXPECT_EQ(json["status"], "failed");
  EXPECT_EQ(json["error"]["code"], "malformed_file");
  EXPECT_EQ(json["error"]["what"], "a.ml:3: no \"number\"");
  EXPECT_EQ(json["stages"][0]["status"], "failed");
  EXPECT_TRUE(json["stages"][0]["digest"].is_null());
  EXPECT_EQ(json["stages"][0]["warnings"][0]["kind"], "odd");
  EXPECT_FALSE(json.contains("model"));
}

TEST(Report, takes_names_of_any_bytes) {
  Job job;
  job.header.name = "caf\xe9 <script>";
  EXPECT_NO_THROW(nlohmann::json::parse(report_json(failed_report(job))));
  EXPECT_EQ(report_html(failed_report(job)).find("<script>"), std::string::npos);
}

TEST(Report, holds_no_time_and_timing_does) {
  Job job;
  JobReport report = failed_report(job);
  const std::string before = report_json(report);
  report.stages[0].timing = {1.5, 2.5, true};
  EXPECT_EQ(report_json(report), before);
  const nlohmann::json timing = nlohmann::json::parse(timing_json(report, 3, 4.0, 5.0));
  EXPECT_EQ(timing["threads"], 3);
  EXPECT_EQ(timing["stages"][0]["cached"], true);
  EXPECT_EQ(timing["stages"][0]["seconds"], 2.5);
}

TEST(Report, comes_with_log_and_resolved_job) {
  Job job;
  std::vector<std::string> names;
  for (const RunFile& file : run_files(failed_report(job), {2, 1.0, 1.0, "/tmp/x"})) names.push_back(file.name);
  EXPECT_THAT(names, testing::ElementsAre("report.json", "timing.json", "report.html", "job.toml", "log.txt"));
}

TEST(Report, names_all_entities_of_a_surface_and_gives_no_number_for_an_unknown_volume) {
  TriangleSoup soup = support::layered_box({0, 0.5, 1});
  support::add_sheet(soup, support::add_patch(soup, "again"), {0, 0, 0}, {1, 1, 1}, 0.5);
  BuiltModel built = *build_structural_model(soup);
  built.model.regions[1].volume_m3 = std::nan("");
  const nlohmann::json model = nlohmann::json::parse(model_json(built, check_validity(built)));
  EXPECT_EQ(model["coincident_surfaces"], nlohmann::json::parse(R"([{"surface": 2, "entity": 1, "entities": [1, 2]}])"));
  for (int entity = 0; entity < 3; ++entity) EXPECT_EQ(model["entities"][entity]["surfaces"], entity == 0 ? 2 : 1);
  EXPECT_EQ(model["volumes_m3"][0], 0.5);
  EXPECT_TRUE(model["volumes_m3"][1].is_null());
  EXPECT_TRUE(model["regions_list"][1]["volume_m3"].is_null());
  EXPECT_THAT(model_text({built, check_validity(built), {}}), HasSubstr("region_2: unknown volume\n"));
}

TEST(Report, says_what_cutting_and_sealing_did_and_the_page_only_if_they_did_something) {
  Job job;
  JobReport report;
  report.job = &job;
  report.sealed = std::make_shared<CutResult>();
  EXPECT_EQ(nlohmann::json::parse(report_json(report))["cut"]["rounds"], 0);
  EXPECT_EQ(report_html(report).find("Cutting and sealing"), std::string::npos);
  CutResult cut;
  cut.report.intersecting_pairs = 7;
  cut.report.rounds = 2;
  cut.changes.push_back({"trimmed", "1 pieces of 'H<1>'", "it juts out"});
  report.sealed = std::make_shared<CutResult>(cut);
  const nlohmann::json block = nlohmann::json::parse(report_json(report))["cut"];
  EXPECT_EQ(block["intersecting_triangle_pairs"], 7);
  EXPECT_EQ(block["rounds"], 2);
  EXPECT_EQ(block["changes"][0]["kind"], "trimmed");
  EXPECT_THAT(report_html(report), HasSubstr("1 pieces of &#39;H&lt;1&gt;&#39;"));
  EXPECT_FALSE(nlohmann::json::parse(report_json(failed_report(job))).contains("cut"));
}

TEST(HtmlPage, escapes_text_and_embeds_pictures) {
  EXPECT_EQ(escaped_html("<a & \"b\">'"), "&lt;a &amp; &quot;b&quot;&gt;&#39;");
  EXPECT_THAT(html_picture({std::byte{'M'}, std::byte{'a'}, std::byte{'n'}}, "x"), HasSubstr("base64,TWFu\""));
  EXPECT_THAT(html_picture({std::byte{'M'}, std::byte{'a'}}, "x"), HasSubstr("base64,TWE=\""));
  EXPECT_THAT(html_picture({std::byte{'M'}}, "x"), HasSubstr("base64,TQ==\""));
  EXPECT_THAT(html_table({"a"}, {{"<b>", "12.5"}}), HasSubstr("<td>&lt;b&gt;</td><td class=\"n\">12.5</td>"));
}

TEST(HtmlPage, draws_a_bar_per_bin) {
  Distribution distribution("angle_deg", 0, 10, 4);
  for (const double value : {1.0, 1.0, 9.0}) distribution.add(value);
  const std::string svg = svg_histogram(distribution);
  std::size_t bars = 0;
  for (std::size_t at = svg.find("<rect"); at != std::string::npos; at = svg.find("<rect", at + 1)) ++bars;
  EXPECT_EQ(bars, 4u);
  EXPECT_THAT(svg, HasSubstr("height=\"110.00\""));  // the fullest bin fills the height
  EXPECT_NO_THROW((void)svg_histogram(Distribution()));
}

TEST(HtmlPage, draws_a_falling_curve_from_its_highest_to_its_lowest_value) {
  const std::string svg = svg_curve({100, 10, 1}, "energy");
  EXPECT_NE(svg.find("0.00,0.00 150.00,55.00 300.00,110.00"), std::string::npos);
  EXPECT_NE(svg.find("energy, 3 steps"), std::string::npos);
  EXPECT_NO_THROW((void)svg_curve({}, "nothing"));
  EXPECT_NO_THROW((void)svg_curve({5}, "one"));
}

TEST(DiffRuns, names_what_is_no_run_folder_or_no_report) {
  const support::ScratchFolder scratch;
  EXPECT_EQ(first_difference(scratch.path(), scratch.path()).failure().code, FailureCode::unreadable_file);
  for (const char* text : {"", "[]", "{\"stages\": 3}", "{\"stages\": [3]}", "{\"stages\": [{}]}"}) {
    write_text(scratch.path() / "report.json", text);
    const auto outcome = first_difference(scratch.path(), scratch.path());
    ASSERT_FALSE(outcome) << text;
    EXPECT_EQ(outcome.failure().code, FailureCode::malformed_file);
  }
}

TEST(Convert, knows_endings_in_any_case) {
  EXPECT_EQ(ending_of("a/b.VTP"), ".vtp");
  EXPECT_FALSE(encode_model({}, ".doc", "x"));
  EXPECT_THAT(writable_endings(), HasSubstr(".vtu"));
}

TEST(CheckModel, fails_on_the_first_file_that_cannot_be_read) {
  const support::ScratchFolder scratch;
  const auto outcome = check_model({scratch.path() / "a.ml", scratch.path() / "b.ml"});
  ASSERT_FALSE(outcome);
  EXPECT_THAT(outcome.failure().what, HasSubstr("a.ml"));
}

TEST(ProgramVersion, is_a_number) { EXPECT_THAT(program_version(), testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+")); }

}  // namespace
}  // namespace strataflow
