#include "stages/cut_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/shapes.h"

namespace strataflow {
namespace {

const SealingNeed needed{true, "asked for"};

/// A box of 10 and a horizon that goes past all its walls.
InputData crossing() {
  InputData data;
  data.surfaces = support::box({0, 0, 0}, {10, 10, 10});
  support::add_sheet(data.surfaces, support::add_patch(data.surfaces, "H1", Role::horizon), {-1, -1, 0}, {11, 11, 0},
                     5);
  return data;
}

TEST(CutStage, cuts_surfaces_along_what_they_share_and_reports_it) {
  StageContext context;
  const Result<CutResult> cut = Cut{}(crossing(), needed, context);
  ASSERT_TRUE(cut) << describe(cut.failure());
  EXPECT_GT(cut->report.intersecting_pairs, 0u);
  EXPECT_EQ(cut->report.pairs_left, 0u);
  EXPECT_GT(cut->soup.triangles.size(), crossing().surfaces.triangles.size());
}

TEST(CutStage, leaves_surfaces_that_need_no_cutting_and_those_not_named) {
  StageContext context;
  const Result<CutResult> unneeded = Cut{}(crossing(), {}, context);
  ASSERT_TRUE(unneeded);
  EXPECT_EQ(unneeded->soup.triangles, crossing().surfaces.triangles);
  Cut by_name;
  by_name.options.cut = {"H1"};
  by_name.options.cutting = {"box"};
  const Result<CutResult> cut = by_name(crossing(), needed, context);
  ASSERT_TRUE(cut) << describe(cut.failure());
  const auto of_box = [](const TriangleSoup& soup) {
    return std::count(soup.triangle_patch.begin(), soup.triangle_patch.end(), 0u);
  };
  EXPECT_EQ(of_box(cut->soup), 12);
  EXPECT_GT(cut->soup.triangles.size(), crossing().surfaces.triangles.size());
}

TEST(CutStage, refuses_a_name_that_is_no_surface) {
  Cut stage;
  stage.options.cutting = {"H9"};
  StageContext context;
  const Result<CutResult> cut = stage(crossing(), needed, context);
  ASSERT_FALSE(cut);
  EXPECT_EQ(cut.failure().code, FailureCode::invalid_options);
}

}  // namespace
}  // namespace strataflow
