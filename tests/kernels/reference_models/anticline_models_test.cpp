#include <gtest/gtest.h>

#include <cmath>

#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/reference_models/soup_topology.h"

namespace strataflow {
namespace {

using namespace testing_support;

TEST(AnticlineModels, have_faults_that_dip_60_degrees_to_the_east) {
  const double cos_60 = 0.5;
  for (const char* name : {"A2", "A3", "A4", "A6"}) {
    const TriangleSoup soup = *generate_reference_model(name, {80.0, {}});
    for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
      if (soup.entities[entity_of(soup, t)].role != Role::fault) continue;
      const auto& [a, b, c] = soup.triangles[t];
      Vec3 normal = cross(soup.points[b] - soup.points[a], soup.points[c] - soup.points[a]);
      normal = (1 / length(normal)) * normal;
      EXPECT_NEAR(std::abs(normal.z), cos_60, 1e-6);
      EXPECT_GT(normal.x * normal.z, 0) << "down to the east";
    }
  }
}

TEST(AnticlineModels, of_growing_throws_have_horizon_traces_that_meet_at_less_than_10_degrees) {
  // The two traces of H2 on the western fault of A4 leave their common corner at the tip.
  const TriangleSoup soup = *generate_reference_model("A4", {20.0, {}});
  const SoupTopology topology = topology_of(soup);
  std::map<std::uint32_t, std::vector<Vec3>> from_tip;
  for (const auto& [edge, around] : topology.edge_triangles) {
    bool fault = false, horizon = false;
    for (const std::uint32_t t : around) {
      fault = fault || soup.entities[entity_of(soup, t)].name == "F1";
      horizon = horizon || soup.entities[entity_of(soup, t)].name == "H2";
    }
    if (!fault || !horizon) continue;
    for (std::size_t k = 0; k < 2; ++k)
      if (soup.points[edge[k]].y == 310) from_tip[edge[k]].push_back(soup.points[edge[1 - k]] - soup.points[edge[k]]);
  }
  ASSERT_EQ(from_tip.size(), 1u);
  const auto& traces = from_tip.begin()->second;
  ASSERT_EQ(traces.size(), 2u);
  const double angle_deg =
      std::acos(dot(traces[0], traces[1]) / (length(traces[0]) * length(traces[1]))) * 57.29577951308232;
  EXPECT_GT(angle_deg, 0.5);
  EXPECT_LT(angle_deg, 10);
}

}  // namespace
}  // namespace strataflow
