#include "stages/simplify_borders_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernels/borders/strips.h"

namespace strataflow {
namespace {

CutResult strips() { return {support::three_strips(), {}, {}}; }

TEST(SimplifyBordersStage, does_nothing_unless_asked) {
  StageContext context;
  const Result<InputData> same = SimplifyBorders{}(strips(), context);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->surfaces.points.size(), strips().soup.points.size());
  EXPECT_TRUE(context.warnings().empty());
}

TEST(SimplifyBordersStage, coarsens_contacts_and_says_by_how_much) {
  StageContext context;
  const Result<InputData> simplified = SimplifyBorders{{true, 1, 45}}(strips(), context);
  ASSERT_TRUE(simplified) << describe(simplified.failure());
  EXPECT_EQ(support::axis_nodes(simplified->surfaces, 0).size(), 11u);
  ASSERT_EQ(context.warnings().size(), 1u);
  EXPECT_EQ(context.warnings()[0].kind, "borders_simplified");
  EXPECT_THAT(context.warnings()[0].what, testing::StartsWith("1 contacts: 27 inner nodes became 9; "));
}

TEST(SimplifyBordersStage, passes_on_what_the_kernel_refuses) {
  StageContext context;
  const Result<InputData> failed = SimplifyBorders{{true, 0, 45}}(strips(), context);
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.failure().code, FailureCode::invalid_options);
}

}  // namespace
}  // namespace strataflow
