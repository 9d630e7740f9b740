#include "kernels/hybrid/shared_surfaces.h"

#include <gtest/gtest.h>

#include "base/id.h"
#include "kernels/hybrid/facing_triangles.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/validity/check_validity.h"

namespace strataflow {
namespace {

Result<SharedSurfaces> remeshed(const StructuralModel& model, std::size_t count, double edge_m) {
  SharedSitesOptions drawing;
  drawing.surface_edge_length_m.assign(model.surfaces.size(), edge_m);
  drawing.thin_ratio = 1;
  SharedSurfacesOptions options;
  options.settle.rounds = 2;
  return remesh_on_shared_sites(model, draw_shared_sites(model, count, drawing), options);
}

TEST(RemeshOnSharedSites, makes_sealed_surfaces_with_the_same_triangles_on_both_sides_of_a_shell) {  // X4, X15
  const StructuralModel spheres = build_structural_model(*generate_reference_model("nested-spheres"))->model;
  const Result<SharedSurfaces> shared = remeshed(spheres, 500, 25);
  ASSERT_TRUE(shared) << shared.failure().what;
  const StructuralModel& model = shared->built.model;
  EXPECT_TRUE(is_sealed(model, check_validity(shared->built)));
  EXPECT_EQ(model.regions.size(), 3u);
  EXPECT_TRUE(shared->changes.empty());
  FacingCounts counts;
  const auto pairs = find_facing_triangles(model, sites_of_points(model), counts);
  std::size_t outer = 0;
  for (const Surface& surface : model.surfaces)
    if (model.entities[surface.entity].name == "Outer") outer += surface.end_triangle - surface.first_triangle;
  EXPECT_GT(outer, 100u);
  EXPECT_EQ(pairs.size(), outer);  // every triangle of the outer sphere faces one of the middle sphere
}

TEST(RemeshOnSharedSites, adds_sites_until_a_faulted_model_is_kept_whole) {
  const StructuralModel faulted = build_structural_model(*generate_reference_model("A2", {.resolution_m = 80}))->model;
  const Result<SharedSurfaces> shared = remeshed(faulted, 60, 350);
  ASSERT_TRUE(shared) << shared.failure().what;
  EXPECT_EQ(shared->built.model.regions.size(), faulted.regions.size());
  EXPECT_EQ(shared->built.model.corners.size(), faulted.corners.size());
  EXPECT_TRUE(is_sealed(shared->built.model, check_validity(shared->built)));
  for (const std::uint32_t site : sites_of_points(shared->built.model)) EXPECT_LT(site, shared->sites);
}

TEST(RemeshOnSharedSites, keeps_lenses_smaller_than_a_cell_with_sites_that_stay_where_they_were_added) {
  const StructuralModel eroded = build_structural_model(*generate_reference_model("A6", {.resolution_m = 80}))->model;
  const Result<SharedSurfaces> shared = remeshed(eroded, 200, 330);
  ASSERT_TRUE(shared) << shared.failure().what;
  EXPECT_EQ(shared->built.model.regions.size(), eroded.regions.size());
  EXPECT_TRUE(is_sealed(shared->built.model, check_validity(shared->built)));
  EXPECT_GT(shared->added_sites, 0u);
  FacingCounts counts;
  EXPECT_FALSE(find_facing_triangles(shared->built.model, sites_of_points(shared->built.model), counts).empty());
}

TEST(RemeshOnSharedSites, refuses_to_work_without_sites) { EXPECT_FALSE(remesh_on_shared_sites({}, {})); }

TEST(SitesOfPoints, are_none_where_no_property_says) {
  StructuralModel model;
  model.points.resize(2);
  EXPECT_EQ(sites_of_points(model), (std::vector<std::uint32_t>{no_index, no_index}));
}

}  // namespace
}  // namespace strataflow
