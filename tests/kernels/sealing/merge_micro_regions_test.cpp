#include "kernels/sealing/merge_micro_regions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernels/contacts/raw_surfaces.h"

namespace strataflow {
namespace {

using support::layered_box;
using support::region_volumes;
using testing::DoubleNear;
using testing::ElementsAre;

MergedRegions merged(const TriangleSoup& soup, const MicroRegions& micro) {
  Result<MergedRegions> result = merge_micro_regions(soup, micro);
  EXPECT_TRUE(result) << (result ? "" : describe(result.failure()));
  return result ? *std::move(result) : MergedRegions{};
}

TEST(MergeMicroRegions, one_of_two_horizons_goes_and_is_named) {
  const MergedRegions result = merged(layered_box({0, 1, 1.001, 2}), {.volume_m3 = 0.01});
  EXPECT_THAT(region_volumes(result.soup), ElementsAre(DoubleNear(0.999, 1e-12), DoubleNear(1.001, 1e-12)));
  ASSERT_EQ(result.changes.size(), 1u);
  EXPECT_EQ(result.changes[0].kind, "merged_micro_region");
  EXPECT_THAT(result.changes[0].what, testing::HasSubstr("'H1'"));
}

TEST(MergeMicroRegions, never_over_a_boundary_surface) {
  const MergedRegions at_the_bottom = merged(layered_box({0, 0.001, 1}), {.volume_m3 = 0.01});
  EXPECT_THAT(region_volumes(at_the_bottom.soup), ElementsAre(DoubleNear(1, 1e-12)));
  TriangleSoup inner_boundary = layered_box({0, 0.001, 1});
  inner_boundary.entities[1].role = Role::boundary;
  EXPECT_EQ(merged(inner_boundary, {.volume_m3 = 0.01}).soup.triangles, inner_boundary.triangles);
  const MergedRegions alone = merged(support::box(), {.volume_m3 = 10});
  EXPECT_EQ(region_volumes(alone.soup).size(), 1u);
  EXPECT_TRUE(alone.changes.empty());
}

TEST(MergeMicroRegions, rather_over_a_horizon_than_over_a_fault) {
  TriangleSoup soup = layered_box({0, 1, 1.001, 2});
  soup.entities[1].role = Role::fault;
  const MergedRegions result = merged(soup, {.volume_m3 = 0.01});
  EXPECT_THAT(region_volumes(result.soup), ElementsAre(DoubleNear(1, 1e-12), DoubleNear(1, 1e-12)));
  EXPECT_THAT(result.changes.at(0).what, testing::HasSubstr("'H2'"));
}

TEST(MergeMicroRegions, slivers_go_by_their_thickness_and_thick_regions_stay) {
  const MicroRegions slivers{.sliver_volume_ratio = 0.01, .sliver_thickness_m = 0.01};
  EXPECT_EQ(region_volumes(merged(layered_box({0, 1, 1.001, 2}), slivers).soup).size(), 2u);
  EXPECT_EQ(region_volumes(merged(layered_box({0, 1, 1.015, 2}), slivers).soup).size(), 3u);
  EXPECT_TRUE(merged(layered_box({0, 1, 2}), {.volume_m3 = 0.5}).changes.empty());
}

TEST(MergeMicroRegions, a_stack_of_them_goes_until_none_is_left) {
  const MergedRegions result = merged(layered_box({0, 1, 1.001, 1.002, 1.003, 2}), {.volume_m3 = 0.01});
  EXPECT_EQ(region_volumes(result.soup).size(), 2u);
  EXPECT_EQ(result.changes.size(), 3u);
}

}  // namespace
}  // namespace strataflow
