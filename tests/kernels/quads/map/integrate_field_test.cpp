#include "kernels/quads/map/integrate_field.h"

#include <gtest/gtest.h>

#include "../field/feature_shapes.h"

namespace strataflow {
namespace {

TEST(IntegrateField, maps_a_square_to_itself_in_units_of_the_quad_edge) {
  FeatureMesh mesh = support::square(8);
  mesh.edge_length_m = 0.1;
  const auto layout = build_feature_layout(mesh);
  FrameField flat;
  flat.turns.assign(layout->opposite.size(), 0);
  flat.axes.assign(layout->opposite.size(), MapAxis::none);
  for (std::uint32_t t = 0; t < layout->triangle_count(); ++t) {
    const Vec3 edge = mesh.points[mesh.triangles[t][1]] - mesh.points[mesh.triangles[t][0]];
    const double a = -std::atan2(edge.y, edge.x);
    flat.angles.push_back({a, a + 1.5707963267948966});
  }
  const auto reduction = reduce_map(mesh, *layout, flat.turns, flat.axes);
  auto energy = MapEnergy::build(*layout, *reduction, mesh.edge_length_m);
  const auto x = integrate_field(*reduction, flat, *energy);
  ASSERT_TRUE(x);
  for (const LinearPart& part : energy->linear_parts(*x)) {
    EXPECT_NEAR(std::abs(part.p), 1, 1e-9);
    EXPECT_NEAR(std::abs(part.q), 0, 1e-9);
  }
}

}  // namespace
}  // namespace strataflow
