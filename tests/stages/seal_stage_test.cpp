#include "stages/seal_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernels/contacts/raw_surfaces.h"
#include "stages/cut_stage.h"

namespace strataflow {
namespace {

using testing::HasSubstr;

const SealingNeed needed{true, "asked for"};

CutResult cut(double gap) {
  InputData data;
  data.surfaces = support::raw_box(gap, 3);
  StageContext context;
  return *Cut{}(data, needed, context);
}

std::vector<std::string> kinds(const StageContext& context) {
  std::vector<std::string> kinds;
  for (const Warning& warning : context.warnings()) kinds.push_back(warning.kind);
  return kinds;
}

TEST(SealStage, closes_small_gaps_and_tells_every_change) {
  StageContext context;
  const Result<CutResult> sealed = Seal{}(cut(0.1), needed, context);
  ASSERT_TRUE(sealed) << describe(sealed.failure());
  EXPECT_EQ(support::region_volumes(sealed->soup).size(), 4u) << support::violations(sealed->soup);
  EXPECT_EQ(context.warnings().size(), sealed->changes.size());
  EXPECT_FALSE(sealed->changes.empty());
}

TEST(SealStage, a_leak_fails_by_name_with_what_to_set) {
  StageContext context;
  const Result<CutResult> sealed = Seal{}(cut(0.5), needed, context);
  ASSERT_FALSE(sealed);
  EXPECT_EQ(sealed.failure().code, FailureCode::invalid_input);
  EXPECT_THAT(sealed.failure().what, HasSubstr("H1 stops 0.5 m short of box"));
  EXPECT_THAT(sealed.failure().remedy, HasSubstr("set seal.distance_m to at least 0.5"));
  EXPECT_THAT(sealed.failure().remedy, HasSubstr("seal.contacts = [\"H1 -> "));
  EXPECT_THAT(kinds(context), testing::Contains("leak"));
}

TEST(SealStage, the_remedy_is_one) {
  Seal stage;
  stage.options.distance_m = 0.7;
  StageContext context;
  const Result<CutResult> sealed = stage(cut(0.5), needed, context);
  ASSERT_TRUE(sealed) << describe(sealed.failure());
  EXPECT_EQ(support::region_volumes(sealed->soup).size(), 4u);
}

TEST(SealStage, leaks_that_are_meant_are_a_warning) {
  Seal stage;
  stage.options.on_leak = "warn";
  StageContext context;
  const Result<CutResult> sealed = stage(cut(0.5), needed, context);
  ASSERT_TRUE(sealed) << describe(sealed.failure());
  EXPECT_THAT(kinds(context), testing::Contains("leak"));
}

TEST(SealStage, leaves_surfaces_that_need_no_sealing) {
  StageContext context;
  const Result<CutResult> same = Seal{}(cut(0.5), {}, context);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->soup.points, cut(0.5).soup.points);
  EXPECT_TRUE(context.warnings().empty());
}

}  // namespace
}  // namespace strataflow
