#include "kernels/complexity/region_thickness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/complexity/models.h"

namespace strataflow {
namespace {

TEST(RegionThickness, between_two_flat_horizons_is_their_distance_and_nowhere_else) {
  const StructuralModel model = model_of(support::layered_box({0, 0.4, 0.5, 1}));
  const ThicknessSamples found = sample_region_thickness(model, find_box_elements(model), {0.05, 0.2});
  double thin_m2 = 0, all_m2 = 0;
  for (const ThicknessSample& sample : found.samples) {
    all_m2 += sample.area_m2;
    const bool between = std::abs(sample.thickness_m - 0.1) < 1e-12;
    EXPECT_TRUE(between || std::isinf(sample.thickness_m)) << sample.thickness_m;
    if (between) thin_m2 += sample.area_m2;
    EXPECT_EQ(between, model.regions[sample.region].volume_m3 < 0.2);
    EXPECT_EQ(sample.is_wedge, 0u);
  }
  EXPECT_NEAR(all_m2, 4, 1e-12);  // two sides of two horizons; the box has no samples
  EXPECT_NEAR(thin_m2, 2, 1e-12);
  EXPECT_GE(found.samples.size(), 4 * 400u);
}

TEST(RegionThickness, of_a_wedge_grows_away_from_its_edge) {
  const StructuralModel model = model_of(fault_below_horizon(30));
  const ThicknessSamples found = sample_region_thickness(model, find_box_elements(model), {0.1, 1});
  for (const ThicknessSample& sample : found.samples) {
    const bool below_horizon = sample.point.z == 2 && std::isfinite(sample.thickness_m);
    if (!below_horizon) continue;
    EXPECT_NEAR(sample.thickness_m, (sample.point.x - 5) * std::tan(std::numbers::pi / 6), 1e-9);
    EXPECT_EQ(sample.is_wedge, 1u);
  }
}

TEST(RegionThickness, is_sampled_more_coarsely_rather_than_for_ever) {
  const StructuralModel model = model_of(support::layered_box({0, 0.4, 0.5, 1}));
  const ThicknessSamples found = sample_region_thickness(model, find_box_elements(model), {1e-5, 0.2, 1000});
  EXPECT_LE(found.samples.size(), 2000u);
  EXPECT_GT(found.spacing_m, 1e-3);
}

}  // namespace
}  // namespace strataflow
