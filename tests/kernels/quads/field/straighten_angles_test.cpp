#include "kernels/quads/field/straighten_angles.h"

#include <gtest/gtest.h>

#include <numbers>

#include "feature_shapes.h"
#include "kernels/quads/field/corner_quads.h"
#include "kernels/quads/field/separate_features.h"

namespace strataflow {
namespace {

constexpr double pi = std::numbers::pi;

TEST(StraightenAngles, opens_an_acute_corner_to_right_angles_and_keeps_triangles_flat) {
  for (const double acute : {0.035, 0.26, 1.0}) {
    const FeatureMesh mesh = *separate_features(support::wedge(6, acute));
    const auto layout = build_feature_layout(mesh);
    const auto quads = choose_corner_quads(mesh, *layout);
    const auto angle = straighten_angles(mesh, *layout, quads);
    ASSERT_TRUE(angle);
    for (std::uint32_t t = 0; t < layout->triangle_count(); ++t)
      EXPECT_NEAR((*angle)[3 * t] + (*angle)[3 * t + 1] + (*angle)[3 * t + 2], pi, 1e-9);
    for (std::uint32_t n = 0; n < layout->node_count(); ++n) {
      if (layout->node_kind[n] != NodeKind::sector) continue;
      double sum = 0;
      for (const std::uint32_t c : layout->corners_of(n)) sum += (*angle)[c];
      EXPECT_NEAR(sum, quads[n] * pi / 2, 1e-6);
    }
  }
}

TEST(StraightenAngles, leaves_right_angles_and_smooth_curves_alone) {
  for (const FeatureMesh& mesh : {support::square_with_fault(8), support::disc(4), support::box_surface(1, 1, 2, 3)}) {
    const auto layout = build_feature_layout(mesh);
    const auto angle = straighten_angles(mesh, *layout, choose_corner_quads(mesh, *layout));
    ASSERT_TRUE(angle);
    for (std::size_t c = 0; c < angle->size(); ++c) EXPECT_NEAR((*angle)[c], layout->angle[c], 1e-9);
  }
}

TEST(StraightenAngles, says_where_a_compartment_has_no_room) {
  const FeatureMesh mesh = support::wedge(1, 0.3);
  const auto layout = build_feature_layout(mesh);
  const auto angle = straighten_angles(mesh, *layout, choose_corner_quads(mesh, *layout));
  ASSERT_FALSE(angle);
  EXPECT_NE(angle.failure().what.find("no point inside"), std::string::npos);
}

}  // namespace
}  // namespace strataflow
