#include <gtest/gtest.h>

#include <cmath>

#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/reference_models/soup_topology.h"

namespace strataflow {
namespace {

using namespace testing_support;

TEST(Diapir, reaches_from_the_bottom_into_the_third_layer) {
  const TriangleSoup soup = *generate_reference_model("D");
  double low = 1e9, high = -1e9;
  for (const Vec3& p : points_of(soup, "Diapir")) {
    low = std::min(low, p.z);
    high = std::max(high, p.z);
  }
  EXPECT_EQ(low, 0);
  EXPECT_NEAR(high, 74, 0.5);
  for (const Vec3& p : points_of(soup, "H3")) EXPECT_GT(p.z, high);
}

TEST(Diapir, stands_on_a_layer_thinner_than_ten_metres_on_average) {
  const SoupTopology topology = topology_of(*generate_reference_model("D"));
  const double thinnest =
      topology.region_volumes.back() < topology.region_volumes[3] ? topology.region_volumes.back() : 0;
  EXPECT_LT(thinnest / (120. * 120 - 3.14159 * 18 * 18), 10);
}

TEST(RawDiapir, leaves_a_gap_around_the_intrusion_and_the_box) {
  for (const double ratio : {0.03, -0.03}) {
    const TriangleSoup soup = *generate_reference_model("D", {4.0, ratio});
    double nearest = 1e9, farthest = 0, foot = 1e9;
    for (const Vec3& p : points_of(soup, "H2")) {
      const double from_axis = std::hypot(p.x - 60, p.y - 60);
      nearest = std::min(nearest, from_axis);
      farthest = std::max(farthest, std::max(std::abs(p.x - 60), std::abs(p.y - 60)));
    }
    for (const Vec3& p : points_of(soup, "Diapir")) foot = std::min(foot, p.z);
    EXPECT_EQ(farthest<60, ratio> 0);
    EXPECT_EQ(foot > 0, ratio > 0);
    EXPECT_EQ(nearest > 25.9, ratio > 0) << "the wall is 26 m from the axis there";
    EXPECT_EQ(piece_count(soup, entity_named(soup, "Diapir")), 1u);
  }
}

}  // namespace
}  // namespace strataflow
