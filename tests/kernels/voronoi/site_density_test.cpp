#include "kernels/voronoi/site_density.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "kernels/topology/building/build_structural_model.h"
#include "kernels/voronoi/diagram_samples.h"

namespace strataflow {
namespace {

StructuralModel model_of(const sample::Mesh& mesh) {
  TriangleSoup soup;
  soup.points = mesh.points;
  soup.triangles = mesh.triangles;
  soup.triangle_patch.assign(mesh.triangles.size(), 0);
  soup.patch_entity = {0};
  soup.entities = {{"H1", Role::horizon}};
  return build_structural_model(soup)->model;
}

double at(const StructuralModel& model, const std::vector<double>& density, const Vec3& x) {
  std::size_t best = 0;
  for (std::size_t i = 0; i < model.points.size(); ++i)
    if (length(model.points[i] - x) < length(model.points[best] - x)) best = i;
  return density[best];
}

TEST(SiteDensity, is_nothing_where_uniform) {
  EXPECT_TRUE(site_density(model_of(sample::flat_sheet(4)), {})->empty());
}

TEST(SiteDensity, falls_with_the_fourth_power_of_the_distance_to_lines) {
  const StructuralModel model = model_of(sample::flat_sheet(10));
  const auto density = *site_density(model, {.kind = DensityKind::near_lines});
  EXPECT_DOUBLE_EQ(at(model, density, {0, 0.5, 0}), 1);
  EXPECT_NEAR(at(model, density, {0.1, 0.5, 0}), std::pow(0.8, 4), 1e-12);
  EXPECT_DOUBLE_EQ(at(model, density, {0.5, 0.5, 0}), 1e-3);  // the middle: 0, raised
}

TEST(SiteDensity, is_larger_where_a_surface_bends) {
  const StructuralModel model = model_of(sample::sheet(20, [](double x, double) { return x > 0.5 ? 2 * (x - 0.5) : 0; }));
  const auto density = *site_density(model, {.kind = DensityKind::curvature});
  EXPECT_NEAR(at(model, density, {0.5, 0.5, 0}), 1, 1e-9);
  EXPECT_DOUBLE_EQ(at(model, density, {0.2, 0.5, 0}), 1e-3);
}

TEST(SiteDensity, a_flat_surface_bends_nowhere) {
  EXPECT_TRUE(site_density(model_of(sample::flat_sheet(4)), {.kind = DensityKind::curvature})->empty());
}

TEST(SiteDensity, takes_a_property_or_names_the_one_that_is_missing) {
  StructuralModel model = model_of(sample::flat_sheet(2));
  PointProperty property{"weight", "", 1, std::vector<double>(model.points.size(), 2)};
  property.values[0] = 4;
  model.properties = {property};
  const auto density = *site_density(model, {.kind = DensityKind::property, .property = "weight"});
  EXPECT_DOUBLE_EQ(density[0], 1);
  EXPECT_DOUBLE_EQ(density[1], 0.5);
  const auto missing = site_density(model, {.kind = DensityKind::property, .property = "wait"});
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.failure().what.find("'wait'"), std::string::npos);
  model.properties[0].values.assign(model.points.size(), -1);
  EXPECT_FALSE(site_density(model, {.kind = DensityKind::property, .property = "weight"}));
}

TEST(SiteDensity, halving_the_edges_of_a_surface_takes_sixteen_times_the_density) {
  const StructuralModel model = model_of(sample::flat_sheet(2));
  const auto density = *site_density(model, {.surface_edge_length_m = {5}, .edge_length_m = 10});
  EXPECT_EQ(density, std::vector<double>(model.points.size(), 16));
}

}  // namespace
}  // namespace strataflow
