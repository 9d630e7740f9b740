#include "kernels/quads/field/field_topology.h"

#include <gtest/gtest.h>

#include <numbers>

#include "feature_shapes.h"
#include "kernels/quads/field/corner_quads.h"
#include "kernels/quads/field/cross_field.h"
#include "kernels/quads/field/straighten_angles.h"

namespace strataflow {
namespace {

constexpr double pi = std::numbers::pi;

FieldTopology crosses_of(const FeatureMesh& mesh, const FeatureLayout& layout) {
  const auto alpha = *smooth_cross_field(mesh, layout, layout.angle);
  std::vector<std::array<double, 2>> frames;
  for (const double a : alpha) frames.push_back({a, a + pi / 2});
  return match_frames(layout, layout.angle, frames);
}

/// R12.
TEST(FieldTopology, turns_of_opposite_half_edges_cancel_and_indices_sum_up_to_the_euler_characteristic) {
  for (const FeatureMesh& mesh :
       {support::square_with_fault(8), support::disc(6), support::box_surface(1, 2, 1, 3), support::torus(12, 8)}) {
    const auto layout = build_feature_layout(mesh);
    const FieldTopology topology = crosses_of(mesh, *layout);
    for (std::uint32_t h = 0; h < layout->opposite.size(); ++h)
      if (layout->opposite[h] != no_index) {
        EXPECT_EQ((topology.turns[h] + topology.turns[layout->opposite[h]]) % 4, 0);
      }
    EXPECT_EQ(index_sum(mesh, *layout, topology), 4 * euler_characteristic(mesh, *layout));
  }
}

TEST(FieldTopology, frames_that_are_relabelled_match_as_before) {
  const FeatureMesh mesh = support::square(4);
  const auto layout = build_feature_layout(mesh);
  const auto alpha = *smooth_cross_field(mesh, *layout, layout->angle);
  std::vector<std::array<double, 2>> frames;
  for (std::size_t t = 0; t < alpha.size(); ++t) {
    const double a = alpha[t] + static_cast<double>(t * 7 % 4) * pi / 2;
    frames.push_back({a, a + pi / 2});
  }
  const FieldTopology topology = match_frames(*layout, layout->angle, frames);
  for (std::size_t n = 0; n < topology.quads.size(); ++n) {
    const std::uint32_t p = layout->node_point[n];
    const bool corner = p == 0 || p == 4 || p == 20 || p == 24;
    const bool inside = layout->node_kind[n] == NodeKind::inside;
    EXPECT_EQ(topology.quads[n], inside ? 4 : corner ? 1 : 2);
  }
}

TEST(FieldTopology, singular_points_leave_features_and_near_pairs_cancel) {
  const FeatureMesh mesh = support::square_with_fault(12);
  const auto layout = build_feature_layout(mesh);
  const auto wanted = choose_corner_quads(mesh, *layout);
  FieldTopology topology = crosses_of(mesh, *layout);
  // Move a quad from a point of the fault to a neighbour inside, and from there on.
  const std::uint32_t node = layout->nodes_of(6 * 13 + 6)[0];
  const std::uint32_t h = layout->corners_of(node)[1], g = layout->opposite[h];
  topology.turns[h] = (topology.turns[h] + 1) & 3;
  topology.turns[g] = (topology.turns[g] + 3) & 3;
  topology.residual[h] -= pi / 2;
  topology.residual[g] += pi / 2;
  --topology.quads[node];
  ++topology.quads[layout->node_of[g]];
  const auto done = settle_singularities(mesh, *layout, wanted, 0, topology);
  ASSERT_TRUE(done);
  EXPECT_EQ(done->off_features, 1u);
  for (std::uint32_t n = 0; n < layout->node_count(); ++n) {
    EXPECT_EQ(topology.quads[n], layout->node_kind[n] == NodeKind::inside ? 4 : wanted[n]);
  }
}

}  // namespace
}  // namespace strataflow
