#include "stages/judge_surfaces_stage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernels/contacts/raw_surfaces.h"

namespace strataflow {
namespace {

SealingNeed need_of(const TriangleSoup& soup, const std::string& mode = "auto") {
  InputData data;
  data.surfaces = soup;
  StageContext context;
  const Result<SealingNeed> need = JudgeSurfaces{{mode}}(data, context);
  EXPECT_TRUE(need) << (need ? "" : describe(need.failure()));
  return need ? *need : SealingNeed{};
}

TEST(JudgeSurfacesStage, a_sealed_model_needs_nothing_also_with_a_fault_that_dies_inside) {
  EXPECT_FALSE(need_of(support::layered_box({0, 1, 2})).is_needed);
  EXPECT_FALSE(need_of(support::box_with_floating_fault()).is_needed);
}

TEST(JudgeSurfacesStage, surfaces_that_cross_need_cutting_and_an_open_box_sealing) {
  TriangleSoup crossing = support::box({0, 0, 0}, {10, 10, 10});
  support::add_sheet(crossing, support::add_patch(crossing, "H1", Role::horizon), {-1, -1, 0}, {11, 11, 0}, 5);
  const SealingNeed need = need_of(crossing);
  EXPECT_TRUE(need.is_needed);
  EXPECT_THAT(need.reason, testing::StartsWith("improper_intersection: "));
  TriangleSoup open = support::box();
  open.triangles.pop_back();
  open.triangle_patch.pop_back();
  EXPECT_TRUE(need_of(open).is_needed);
}

TEST(JudgeSurfacesStage, loose_surfaces_that_nearly_reach_the_box_leak_unless_the_file_lists_its_regions) {
  TriangleSoup soup = support::raw_box(0.1, 3);
  const SealingNeed need = need_of(soup);
  EXPECT_TRUE(need.is_needed);
  EXPECT_THAT(need.reason, testing::StartsWith("leak: F1 stops 0.1 m short of box"));
  soup.regions.push_back({"all", {{0, 1}}});
  EXPECT_FALSE(need_of(soup).is_needed);
}

TEST(JudgeSurfacesStage, does_as_it_is_told) {
  EXPECT_FALSE(need_of(support::raw_box(0.1, 3), "never").is_needed);
  EXPECT_TRUE(need_of(support::layered_box({0, 1, 2}), "always").is_needed);
  EXPECT_EQ(need_of(support::layered_box({0, 1, 2}), "always").reason, "asked for");
}

}  // namespace
}  // namespace strataflow
