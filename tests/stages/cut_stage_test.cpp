#include "stages/cut_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/shapes.h"

namespace strataflow {
namespace {

const SealingNeed needed{true, "asked for"};

/// A box of 10 and a horizon that goes past all its walls.
CutResult crossing() {
  CutResult joined{support::box({0, 0, 0}, {10, 10, 10}), {}, {{"contact_made", "H0 on box", "it nearly touched"}}};
  support::add_sheet(joined.soup, support::add_patch(joined.soup, "H1", Role::horizon), {-1, -1, 0}, {11, 11, 0}, 5);
  return joined;
}

TEST(CutStage, cuts_surfaces_along_what_they_share_and_reports_it) {
  StageContext context;
  const Result<CutResult> cut = Cut{}(crossing(), needed, context);
  ASSERT_TRUE(cut) << describe(cut.failure());
  EXPECT_GT(cut->report.intersecting_pairs, 0u);
  EXPECT_EQ(cut->report.pairs_left, 0u);
  EXPECT_GT(cut->soup.triangles.size(), crossing().soup.triangles.size());
  EXPECT_TRUE(cut->soup.properties.empty());
  ASSERT_FALSE(cut->changes.empty());
  EXPECT_EQ(cut->changes[0].kind, "contact_made") << "what was done before is told first";
  EXPECT_EQ(context.warnings().size(), cut->changes.size() - 1) << "its own stage has warned of it";
}

TEST(CutStage, marks_the_points_it_made_if_asked) {
  Cut stage;
  stage.options.mark_inserted = true;
  StageContext context;
  const Result<CutResult> cut = stage(crossing(), needed, context);
  ASSERT_TRUE(cut) << describe(cut.failure());
  ASSERT_EQ(cut->soup.properties.size(), 1u);
  const PointProperty& mark = cut->soup.properties[0];
  EXPECT_EQ(mark.name, "inserted_by_cut");
  ASSERT_EQ(mark.values.size(), cut->soup.points.size());
  EXPECT_EQ(std::count(mark.values.begin(), mark.values.end(), 1.0),
            static_cast<std::ptrdiff_t>(cut->report.new_points));
}

TEST(CutStage, leaves_surfaces_that_need_no_cutting_and_those_not_named) {
  StageContext context;
  const Result<CutResult> unneeded = Cut{}(crossing(), {}, context);
  ASSERT_TRUE(unneeded);
  EXPECT_EQ(unneeded->soup.triangles, crossing().soup.triangles);
  Cut by_name;
  by_name.options.cut = {"H1"};
  by_name.options.cutting = {"box"};
  const Result<CutResult> cut = by_name(crossing(), needed, context);
  ASSERT_TRUE(cut) << describe(cut.failure());
  const auto of_box = [](const TriangleSoup& soup) {
    return std::count(soup.triangle_patch.begin(), soup.triangle_patch.end(), 0u);
  };
  EXPECT_EQ(of_box(cut->soup), 12);
  EXPECT_GT(cut->soup.triangles.size(), crossing().soup.triangles.size());
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
