#include "kernels/hybrid/settle_shared_sites.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/topology/building/build_structural_model.h"

namespace strataflow {
namespace {

StructuralModel slab() { return build_structural_model(*generate_reference_model("slab"))->model; }

TEST(HeldEnergy, has_the_gradient_of_its_value) {
  const StructuralModel model = slab();
  std::vector<Vec3> sites{{200, 200, 4}, {700, 300, 12}, {400, 600, 9}, {850, 650, 15}};
  std::vector<SheetHold> holds(4);
  holds[0] = {{0, 0, 10}, {0, 0, 1}};
  holds[2] = {{0, 0, 10}, {0, 0.6, 0.8}};
  HeldEnergy energy({model.points, model.triangles, {}, {}}, holds);
  CvtTerms terms, moved;
  energy.evaluate(sites, false, terms);
  for (std::size_t i = 0; i < sites.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double step = 1e-3;
      std::vector<Vec3> at = sites;
      at[i][axis] += step;
      energy.evaluate(at, false, moved);
      const double above = moved.quantization;
      at[i][axis] -= 2 * step;
      energy.evaluate(at, false, moved);
      const double slope = (above - moved.quantization) / (2 * step);
      EXPECT_NEAR(terms.quantization_gradient[i][axis], slope, 1e-5 * std::abs(slope) + 1e3) << i << " " << axis;
    }
}

TEST(SettleSharedSites, keeps_sites_between_sheets_that_stand_apart_by_an_edge) {
  const StructuralModel model = slab();  // 20 m
  SharedSitesOptions drawing;
  drawing.surface_edge_length_m.assign(model.surfaces.size(), 21);
  drawing.thin_ratio = 1;
  const SharedSites shared = draw_shared_sites(model, 4400, drawing);
  const Result<OptimisedSites> settled =
      settle_shared_sites(model, {model.points, model.triangles, {}, {}}, shared, {.rounds = 2});
  ASSERT_TRUE(settled);
  std::size_t between = 0;
  for (std::size_t i = 0; i < shared.sites.size(); ++i)
    between += !shared.stacks[i].empty() && std::abs(settled->sites[i].z - 10) < 2;
  EXPECT_GT(between, shared.across_layers * 95 / 100);
}

TEST(SettleSharedSites, leaves_pinned_sites_where_they_are) {
  const StructuralModel model = slab();
  SharedSitesOptions drawing;
  drawing.surface_edge_length_m.assign(model.surfaces.size(), 150);
  SharedSites shared = draw_shared_sites(model, 100, drawing);
  shared.is_pinned = {1, 1};  // those beyond move
  const Result<OptimisedSites> settled =
      settle_shared_sites(model, {model.points, model.triangles, {}, {}}, shared, {.rounds = 1});
  ASSERT_TRUE(settled);
  EXPECT_EQ(settled->sites[0], shared.sites[0]);
  EXPECT_EQ(settled->sites[1], shared.sites[1]);
  EXPECT_NE(settled->sites[2], shared.sites[2]);
}

TEST(FindSheetHolds, looks_only_at_the_sheets_of_a_stack) {
  const StructuralModel model = slab();
  const std::vector<Vec3> sites{{300, 400, 3}, {700, 400, 3}};
  std::uint32_t low = 0, high = 0;
  for (std::uint32_t s = 0; s < model.surfaces.size(); ++s) {
    if (model.entities[model.surfaces[s].entity].name == "Bottom") low = s;
    if (model.entities[model.surfaces[s].entity].name == "Top") high = s;
  }
  const auto holds = find_sheet_holds(model, sites, {{std::min(low, high), std::max(low, high)}, {low}});
  ASSERT_TRUE(holds);
  EXPECT_NEAR((*holds)[0].middle.z, 10, 1e-9);
  EXPECT_NEAR(std::abs((*holds)[0].normal.z), 1, 1e-12);
  EXPECT_EQ((*holds)[1].normal, Vec3{});
}

}  // namespace
}  // namespace strataflow
