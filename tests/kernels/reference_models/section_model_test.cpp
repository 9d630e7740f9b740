#include "kernels/reference_models/section_model.h"

#include <gtest/gtest.h>

#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/reference_models/soup_topology.h"

namespace strataflow {
namespace {

using namespace testing_support;

TriangleSoup raw(std::string_view name, double ratio) { return *generate_reference_model(name, {50.0, ratio}); }

Box3 extent(const TriangleSoup& soup, std::string_view name) {
  Box3 box;
  for (const Vec3& p : points_of(soup, name)) box.take(p);
  return box;
}

TEST(RawSections, stop_short_of_the_box_by_the_ratio_of_their_extent) {
  const TriangleSoup soup = raw("A1", 0.02);
  for (const char* name : {"H1", "H2", "H3"}) {
    const Box3 box = extent(soup, name);
    EXPECT_NEAR(box.low.x, 32, 1e-9);
    EXPECT_NEAR(box.high.x, 1568, 1e-9);
    EXPECT_NEAR(box.low.y, 18.6, 1e-9);
    EXPECT_NEAR(box.high.y, 911.4, 1e-9);
  }
}

TEST(RawSections, overshoot_for_a_negative_ratio) {
  const TriangleSoup soup = raw("A2", -0.01);
  EXPECT_NEAR(extent(soup, "H1").low.y, -9.3, 1e-9);
  EXPECT_NEAR(extent(soup, "H1").high.y, 939.3, 1e-9);
  EXPECT_LT(extent(soup, "H1").low.x, -4.9);
  EXPECT_NEAR(extent(soup, "F1").low.z, -5, 1e-9);
  EXPECT_NEAR(extent(soup, "F1").high.z, 505, 1e-9);
}

TEST(RawSections, have_one_sheet_per_fault_block_joined_around_tips) {
  for (const double ratio : {0.02, -0.02}) {
    EXPECT_EQ(piece_count(raw("A1", ratio), 0), 1u);
    EXPECT_EQ(piece_count(raw("A2", ratio), 0), 3u);
    EXPECT_EQ(piece_count(raw("A3", ratio), 0), 1u);
    EXPECT_EQ(piece_count(raw("A4", ratio), 0), 2u);
    EXPECT_EQ(piece_count(raw("A5", ratio), 0), 3u);
    EXPECT_EQ(piece_count(raw("B", ratio), entity_named(raw("B", ratio), "H3")), 2u);
    EXPECT_EQ(piece_count(raw("B", ratio), entity_named(raw("B", ratio), "H2")), 1u) << "a décollement is not cut";
  }
}

TEST(RawSections, keep_tips_where_they_are) {
  const Box3 local = extent(raw("A3", 0.05), "F1");
  EXPECT_NEAR(local.low.y, 200, 1e-9);
  EXPECT_NEAR(local.high.y, 680, 1e-9);
  const Box3 thrust = extent(raw("B", 0.05), "F1");
  EXPECT_NEAR(thrust.high.z, 380, 1e-9) << "its tip";
  EXPECT_NEAR(thrust.low.z, 120 + 0.05 * 260, 1e-9) << "its contact with the décollement";
}

TEST(RawSections, end_before_or_after_the_surface_that_cuts_them) {
  // H1 of C lies at 260 m and ends on U.
  const auto reach = [](double ratio) { return extent(raw("C", ratio), "H1").high.x; };
  EXPECT_LT(reach(0.05), reach(1e-6));
  EXPECT_LT(reach(1e-6), reach(-0.05));
  const TriangleSoup eroded = raw("A6", 0.02);
  EXPECT_LT(extent(eroded, "H3").high.z, extent(raw("A4", 0.02), "H3").high.z) << "the crest is gone";
}

}  // namespace
}  // namespace strataflow
