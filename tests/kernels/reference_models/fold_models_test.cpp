#include <gtest/gtest.h>

#include <cmath>

#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/reference_models/soup_topology.h"

namespace strataflow {
namespace {

using namespace testing_support;

TEST(FaultPropagationFold, leaves_the_decollement_at_a_low_dip_and_steepens) {
  const TriangleSoup soup = *generate_reference_model("B", {20.0, {}});
  double at_base_deg = 90, at_tip_deg = 0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if (soup.entities[entity_of(soup, t)].name != "F1") continue;
    const auto& [a, b, c] = soup.triangles[t];
    const Vec3 normal = cross(soup.points[b] - soup.points[a], soup.points[c] - soup.points[a]);
    const double dip_deg = std::acos(std::abs(normal.z) / length(normal)) * 57.29577951308232;
    at_base_deg = std::min(at_base_deg, dip_deg);
    at_tip_deg = std::max(at_tip_deg, dip_deg);
  }
  EXPECT_LT(at_base_deg, 18);
  EXPECT_GT(at_tip_deg, 50);
}

TEST(OnlapOnFold, ends_the_lower_flat_horizon_on_the_folded_one) {
  const TriangleSoup soup = *generate_reference_model("C", {40.0, {}});
  for (const Vec3& p : points_of(soup, "H1")) {
    const bool is_near_contact = p.x > 700 && p.x < 1000;  // contacts close to a grid point move onto it
    EXPECT_NEAR(p.z, 260, is_near_contact ? 1.5 : 1e-9);
  }
  for (const Vec3& p : points_of(soup, "H2")) EXPECT_NEAR(p.z, 400, 1e-9);
  double folded_above = 0;
  for (const Vec3& p : points_of(soup, "U")) folded_above = std::max(folded_above, p.z);
  EXPECT_GT(folded_above, 300);
}

}  // namespace
}  // namespace strataflow
