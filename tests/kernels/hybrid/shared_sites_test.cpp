#include "kernels/hybrid/shared_sites.h"

#include <gtest/gtest.h>

#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/topology/building/build_structural_model.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

StructuralModel model_of(std::string_view name) {
  return build_structural_model(*generate_reference_model(name))->model;
}

SharedSites drawn(const StructuralModel& model, std::size_t count, double edge_m, double thin_ratio) {
  SharedSitesOptions options;
  options.surface_edge_length_m.assign(model.surfaces.size(), edge_m);
  options.thin_ratio = thin_ratio;
  return draw_shared_sites(model, count, options);
}

TEST(DrawSharedSites, the_two_sides_of_a_plate_have_their_sites_in_common_half_way) {
  const StructuralModel slab = model_of("slab");  // 20 m thick
  const SharedSites shared = drawn(slab, 400, 70, 1);
  EXPECT_NEAR(static_cast<double>(shared.sites.size()), 200, 25);  // walls have few
  EXPECT_GT(shared.across_layers, 150u);
  for (std::size_t i = 0; i < shared.sites.size(); ++i) {
    if (shared.stacks[i].empty()) continue;
    EXPECT_NEAR(shared.sites[i].z, 10, 1e-6);
    EXPECT_EQ(shared.stacks[i].size(), 2u);
  }
}

TEST(DrawSharedSites, nothing_is_thin_where_edges_are_short) {
  const SharedSites shared = drawn(model_of("slab"), 400, 15, 1);
  EXPECT_EQ(shared.sites.size(), 400u);
  EXPECT_EQ(shared.across_layers, 0u);
}

TEST(DrawSharedSites, of_nested_shells_the_nearest_go_together_first) {  // X15: shells of 20 and 10 m
  const StructuralModel spheres = model_of("nested-spheres");
  const SharedSites thin = drawn(spheres, 1000, 15, 1);
  Box3 box;
  for (const Vec3& p : spheres.points) box.take(p);
  for (std::size_t i = 0; i < thin.sites.size(); ++i) {
    if (thin.stacks[i].empty()) continue;
    EXPECT_NEAR(length(thin.sites[i] - box.centre()), 95, 1);
  }
  EXPECT_GT(thin.across_layers, 300u);
  const SharedSites thick = drawn(spheres, 1000, 35, 1);  // all three
  for (std::size_t i = 0; i < thick.sites.size(); ++i) EXPECT_EQ(thick.stacks[i].size(), 3u);
}

TEST(DrawSharedSites, is_the_same_on_every_schedule) {
  const StructuralModel slab = model_of("slab");
  const SharedSites wanted = drawn(slab, 300, 60, 1);
  support::on_every_schedule(
      [&](const char* schedule) { EXPECT_EQ(drawn(slab, 300, 60, 1).sites, wanted.sites) << schedule; });
}

}  // namespace
}  // namespace strataflow
