#include "stages/cut_constrained_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernels/contacts/raw_surfaces.h"

namespace strataflow {
namespace {

using testing::HasSubstr;

const SealingNeed needed{true, "asked for"};

InputData raw(double gap) {
  InputData data;
  data.surfaces = support::raw_box(gap, 3);
  return data;
}

TEST(CutConstrainedStage, leads_what_nearly_touches_into_four_regions_and_says_how_far) {
  StageContext context;
  const Result<CutResult> cut = CutConstrained{}(raw(0.1), needed, context);
  ASSERT_TRUE(cut) << describe(cut.failure());
  EXPECT_EQ(support::region_volumes(cut->soup).size(), 4u);
  ASSERT_EQ(context.warnings().size(), 3u);  // F1 and H1 on the box, H1 on F1
  EXPECT_EQ(context.warnings()[0].kind, "contact_made");
  EXPECT_THAT(context.warnings()[0].what, HasSubstr("F1 stops 0.1 m short of box"));
  ASSERT_EQ(cut->changes.size(), 3u) << "the report tells them beside what cutting changed";
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(cut->changes[i].kind, "contact_made");
    EXPECT_EQ(cut->changes[i].what + ": " + cut->changes[i].why, context.warnings()[i].what);
    EXPECT_EQ(cut->changes[i].why, "it nearly touched");
  }
}

TEST(CutConstrainedStage, wider_gaps_are_closed_by_name_only) {
  CutConstrained stage;
  StageContext unasked;
  EXPECT_NE(support::region_volumes(stage(raw(0.8), needed, unasked)->soup).size(), 4u);
  stage.options.contacts = {"F1 -> box within 0.9", "H1 -> box within 1.2", "H1 -> F1 within 0.9"};
  StageContext asked;
  const Result<CutResult> cut = stage(raw(0.8), needed, asked);
  ASSERT_TRUE(cut) << describe(cut.failure());
  EXPECT_EQ(support::region_volumes(cut->soup), (std::vector<double>{250, 250, 250, 250}));
  for (const Change& change : cut->changes) EXPECT_EQ(change.why, "asked for by name") << change.what;
}

TEST(CutConstrainedStage, a_distance_of_0_leaves_everything_and_a_wrong_name_is_refused) {
  CutConstrained stage;
  stage.options.distance_m = 0;
  StageContext context;
  EXPECT_EQ(stage(raw(0.1), needed, context)->soup.triangles.size(), raw(0.1).surfaces.triangles.size());
  EXPECT_TRUE(context.warnings().empty());
  stage.options.contacts = {"H9 -> F1"};
  EXPECT_EQ(stage(raw(0.1), needed, context).failure().code, FailureCode::invalid_options);
}

TEST(CutConstrainedStage, leaves_surfaces_that_need_no_sealing) {
  StageContext context;
  const Result<CutResult> same = CutConstrained{}(raw(0.1), {}, context);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->soup.points, raw(0.1).surfaces.points);
  EXPECT_TRUE(context.warnings().empty());
}

}  // namespace
}  // namespace strataflow
