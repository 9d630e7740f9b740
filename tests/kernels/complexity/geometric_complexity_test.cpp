#include "kernels/complexity/geometric_complexity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/complexity/models.h"

namespace strataflow {
namespace {

TEST(GeometricComplexity, of_flat_thick_layers_is_zero) {
  EXPECT_EQ(geometric_of(model_of(support::layered_box({0, 0.4, 1})), 0.1).total(), 0);
}

TEST(GeometricComplexity, of_a_thin_layer_is_the_whole_of_its_boundary) {
  const GeometricComplexity found = geometric_of(model_of(support::layered_box({0, 0.4, 0.45, 1})), 0.1);
  const ElementComplexity regions = found.sum_of(ElementType::region);
  EXPECT_EQ(regions.element, 3u);
  EXPECT_DOUBLE_EQ(regions.thin, 1);  // the layer; its neighbours are thick seen from inside
  EXPECT_EQ(regions.too_small, 0);
  EXPECT_DOUBLE_EQ(found.total(), 1);
}

TEST(GeometricComplexity, counts_what_is_smaller_than_an_edge) {
  const StructuralModel model = model_of(support::layered_box({0, 0.4, 0.45, 1}));
  EXPECT_EQ(geometric_of(model, 0.3).sum_of(ElementType::region).too_small, 0);   // 0.05 m³ against 0.027
  EXPECT_EQ(geometric_of(model, 0.4).sum_of(ElementType::region).too_small, 1);   // against 0.064
  EXPECT_EQ(geometric_of(model, 0.99).sum_of(ElementType::surface).too_small, 0);
  EXPECT_EQ(geometric_of(model, 1.01).sum_of(ElementType::surface).too_small, 2);
}

TEST(GeometricComplexity, sees_the_sharp_edge_of_a_wedge_below_the_angle_only) {
  EXPECT_EQ(geometric_of(model_of(fault_below_horizon(25)), 0.1, 20).sum_of(ElementType::region).sharp, 0);
  EXPECT_EQ(geometric_of(model_of(fault_below_horizon(15)), 0.1, 20).sum_of(ElementType::region).sharp, 1);
}

TEST(GeometricComplexity, of_a_wedge_is_the_share_of_its_sides_thinner_than_the_edge) {
  const double angle = 15 * std::numbers::pi / 180, h = 0.5, wedge_side = 2 / std::sin(angle);
  const StructuralModel model = model_of(fault_below_horizon(15));
  const GeometricComplexity found = geometric_of(model, h);
  const double thin = h / std::tan(angle);  // of either side, up to where the normal ray is h long
  for (const ElementComplexity& one : found.elements) {
    if (one.type != ElementType::region || one.sharp == 0) continue;
    EXPECT_NEAR(one.thin, 2 * thin / (wedge_side + 15), 0.01);  // the horizon is 15 wide there
  }
}

TEST(GeometricComplexity, of_a_folded_sheet_is_what_its_projection_loses) {
  TriangleSoup soup = support::box({0, 0, 0}, {4, 4, 4});
  const std::uint32_t h = support::add_patch(soup, "H1", Role::horizon);  // two limbs of 45°
  support::add_quad(soup, h, {1, 1, 1}, {2, 1, 2}, {2, 3, 2}, {1, 3, 1});
  support::add_quad(soup, h, {2, 1, 2}, {3, 1, 1}, {3, 3, 1}, {2, 3, 2});
  const GeometricComplexity found = geometric_of(model_of(soup), 0.1);
  EXPECT_NEAR(found.sum_of(ElementType::surface).shape, 1 - std::sqrt(0.5), 1e-12);
  const double border = 4 + 4 * std::sqrt(2.0);  // a closed line: its limbs lose too
  EXPECT_NEAR(found.sum_of(ElementType::line).shape, 1 - 8 / border, 1e-12);
}

TEST(SizeVariation, is_of_a_sample_and_unknown_for_fewer_than_two) {
  const SizeVariation found = measure_size_variation(geometric_of(model_of(support::layered_box({0, 0.25, 1})), 0.1));
  EXPECT_NEAR(found.regions, std::sqrt(0.125) / 0.5, 1e-12);  // 0.25 and 0.75
  EXPECT_TRUE(std::isnan(found.surfaces));
  EXPECT_TRUE(std::isnan(found.lines));
  EXPECT_DOUBLE_EQ(found.total(), found.regions);
}

}  // namespace
}  // namespace strataflow
