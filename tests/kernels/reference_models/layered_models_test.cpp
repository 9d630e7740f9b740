#include <gtest/gtest.h>

#include <cmath>

#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/reference_models/reference_plans.h"
#include "kernels/reference_models/soup_topology.h"

namespace strataflow {
namespace {

using namespace testing_support;

double steepest_deg(const TriangleSoup& soup, std::string_view name, double from_z, double to_z) {
  double most = 0;
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    if (soup.entities[entity_of(soup, t)].name != name) continue;
    const auto& [a, b, c] = soup.triangles[t];
    const double z = (soup.points[a].z + soup.points[b].z + soup.points[c].z) / 3;
    const Vec3 normal = cross(soup.points[b] - soup.points[a], soup.points[c] - soup.points[a]);
    if (z >= from_z && z <= to_z) most = std::max(most, std::acos(std::abs(normal.z) / length(normal)));
  }
  return most * 57.29577951308232;
}

TEST(VariableLayers, are_8_m_thick_at_least_and_vary_by_more_than_two_thirds) {
  const auto model = variable_layers();
  for (std::uint32_t layer = 0; layer < 5; ++layer) {
    double thinnest = 1e9, thickest = 0;
    for (double b = 0; b <= 1500; b += 50)
      for (double a = 0; a <= 1; a += 0.05) {
        const double thick = model->height(0, layer + 1, {a, b, 0}) - model->height(0, layer, {a, b, 0});
        thinnest = std::min(thinnest, thick);
        thickest = std::max(thickest, thick);
      }
    EXPECT_GE(thinnest, 8 - 1e-9) << layer;
    EXPECT_GT(thickest / thinnest, 1.7) << layer;
  }
}

TEST(Veins, are_6_to_20_m_thick_and_steep) {
  const TriangleSoup soup = *generate_reference_model("veins", {150, {}});
  for (const char* name : {"V1West", "V7East", "V14West"}) EXPECT_GT(steepest_deg(soup, name, 0, 280), 70) << name;
  const auto model = veins();
  for (std::uint32_t vein = 0; vein < 14; ++vein)
    for (const double z : {10.0, 140.0, 270.0})
      for (const double y : {100.0, 600.0, 1200.0}) {
        const double thick =
            model->at(2 * vein + 1, {2. * vein + 2, y, 0}, z).x - model->at(2 * vein + 1, {2. * vein + 1, y, 0}, z).x;
        EXPECT_GE(thick, 6 - 1e-9);
        EXPECT_LE(thick, 20 + 1e-9);
      }
}

TEST(Onlap, ends_its_layers_at_grazing_angles) {
  const TriangleSoup soup = *generate_reference_model("onlap", {1.5, {}});
  const SoupTopology topology = topology_of(soup);
  std::size_t contacts = 0;
  double mean_deg = 0;
  for (const auto& [edge, around] : topology.edge_triangles) {
    const auto horizon = std::find_if(around.begin(), around.end(), [&](std::uint32_t t) {
      const std::string& name = soup.entities[entity_of(soup, t)].name;
      return name >= "H2" && name <= "H6";
    });
    if (around.size() != 3 || horizon == around.end()) continue;
    const auto normal_of = [&](std::uint32_t t) {
      const auto& [a, b, c] = soup.triangles[t];
      const Vec3 n = cross(soup.points[b] - soup.points[a], soup.points[c] - soup.points[a]);
      return (1 / length(n)) * n;
    };
    for (const std::uint32_t t : around) {
      if (t == *horizon || soup.entities[entity_of(soup, t)].name != "U") continue;
      mean_deg += std::acos(std::min(1.0, std::abs(dot(normal_of(t), normal_of(*horizon))))) * 57.29577951308232;
      ++contacts;
    }
  }
  ASSERT_GT(contacts, 100u);
  EXPECT_LT(mean_deg / static_cast<double>(contacts), 8);
}

TEST(Sandbox, has_faults_that_flatten_downwards_and_dip_to_a_graben) {
  const TriangleSoup soup = *generate_reference_model("sandbox", {100, {}});
  EXPECT_GT(steepest_deg(soup, "F1", 430, 500), 78);
  EXPECT_LT(steepest_deg(soup, "F1", 50, 100), 55);
  const auto model = sandbox();
  EXPECT_GT(model->at(0, {1, 0, 0}, 100).x, model->at(0, {1, 0, 0}, 400).x) << "F1 dips east";
  EXPECT_LT(model->at(32, {33, 0, 0}, 100).x, model->at(32, {33, 0, 0}, 400).x) << "F33 dips west";
  EXPECT_LT(model->height(20, 4, {20.5, 900, 0}), model->height(0, 4, {0.5, 900, 0}) - 20) << "the graben is low";
}

}  // namespace
}  // namespace strataflow
