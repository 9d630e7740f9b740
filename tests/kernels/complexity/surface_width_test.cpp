#include "kernels/complexity/surface_width.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/complexity/models.h"

namespace strataflow {
namespace {

std::vector<WidthSample> widths(const TriangleSoup& soup, double spacing_m, double reach_m) {
  const StructuralModel model = model_of(soup);
  return sample_surface_width(model, find_box_elements(model), build_edge_table(model.points.size(), model.triangles),
                              spacing_m, reach_m);
}

TEST(SurfaceWidth, of_a_free_rectangle_is_its_sides) {
  for (const TriangleSoup& soup :
       {support::box_with_floating_fault(), refined(refined(support::box_with_floating_fault()))}) {
    const auto samples = widths(soup, 0.1, 10);
    double length_m = 0;
    for (const WidthSample& sample : samples) {
      EXPECT_NEAR(sample.width_m, 2, 1e-12);
      length_m += sample.length_m;
    }
    EXPECT_NEAR(length_m, 8, 1e-12);
    EXPECT_GE(samples.size(), 80u);
  }
}

TEST(SurfaceWidth, is_endless_beyond_its_reach) {
  for (const WidthSample& sample : widths(support::box_with_floating_fault(), 0.5, 1.5))
    EXPECT_TRUE(std::isinf(sample.width_m));
}

TEST(SurfaceWidth, goes_round_bends) {  // a strip 1 wide, folded by 90° along its middle, floats in a box
  TriangleSoup soup = support::box({0, 0, 0}, {4, 4, 4});
  const std::uint32_t f = support::add_patch(soup, "F1", Role::fault);
  support::add_quad(soup, f, {1, 1, 1}, {3, 1, 1}, {3, 1.5, 1}, {1, 1.5, 1});
  support::add_quad(soup, f, {1, 1.5, 1}, {3, 1.5, 1}, {3, 1.5, 1.5}, {1, 1.5, 1.5});
  double narrow_m = 0;
  for (const WidthSample& sample : widths(soup, 0.1, 1.5)) {
    if (std::isinf(sample.width_m)) continue;
    EXPECT_NEAR(sample.width_m, 1, 1e-12);
    narrow_m += sample.length_m;
  }
  EXPECT_NEAR(narrow_m, 4, 1e-12);
}

}  // namespace
}  // namespace strataflow
