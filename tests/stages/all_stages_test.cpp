#include "stages/all_stages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "stages/stage_description.h"
#include "support/command_line.h"

namespace strataflow {
namespace {

using testing::HasSubstr;

TEST(AllStages, have_names_of_their_own_and_a_summary) {
  std::set<std::string> names;
  for (const StageDescription& stage : all_stages()) {
    EXPECT_TRUE(names.insert(stage.name).second) << stage.name;
    EXPECT_FALSE(stage.summary.empty());
    EXPECT_GE(stage.version, 1);
    EXPECT_EQ(stage.options.empty(), stage.section.empty()) << stage.name << ": options need a section to be set in";
    for (const OptionDescription& option : stage.options) EXPECT_FALSE(option.description.empty()) << option.name;
  }
}

TEST(AllStages, are_described_from_their_types) {
  for (const StageDescription& stage : all_stages()) {
    if (stage.name == "combine") {
      EXPECT_THAT(stage.inputs, testing::ElementsAre("input data …"));
    }
    if (stage.name != "tetrahedralize") continue;
    EXPECT_THAT(stage.inputs, testing::ElementsAre("structural model", "validity report"));
    EXPECT_EQ(stage.output, "volume mesh");
    for (const OptionDescription& option : stage.options) {
      if (option.name == "timeout_s") {
        EXPECT_EQ(option.unit, "s");
        EXPECT_EQ(option.domain, "> 0");
        EXPECT_EQ(option.default_value, "300.0");
      }
      if (option.name == "max_volume_m3") {
        EXPECT_EQ(option.unit, "m³");
        EXPECT_EQ(option.default_value, "");
      }
      if (option.name == "split_surfaces") {
        EXPECT_EQ(option.domain, "auto | never");
      }
    }
  }
}

TEST(AllStages, are_documented_as_they_are) {
  const std::string file = std::string(STRATAFLOW_SOURCE_DIR) + "/docs/stages.md";
  EXPECT_EQ(support::read_text(file), stages_as_markdown()) << "run: strataflow stages --markdown > docs/stages.md";
}

TEST(AllStages, have_every_option_in_the_readme_of_the_job_files) {
  const std::string readme = support::read_text(std::string(STRATAFLOW_SOURCE_DIR) + "/configs/README.md");
  for (const StageDescription& stage : all_stages()) {
    for (const OptionDescription& option : stage.options)
      EXPECT_THAT(readme, HasSubstr("`" + option.name + "`")) << stage.name;
  }
}

}  // namespace
}  // namespace strataflow
