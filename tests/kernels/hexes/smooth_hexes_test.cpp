#include "kernels/hexes/smooth_hexes.h"

#include <gtest/gtest.h>

#include "kernels/hexes/hex_checks.h"
#include "kernels/hexes/tet_models.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

/// A box under a fault, its plan jittered inside.
struct Jittered {
  LayeredSpace space;
  ExtrudedHexes hexes;
};

Jittered jittered() {
  const auto columns = vertical_faults(1, false);
  Jittered result{support::upright(support::filled(*columns, 120), {2, {}, {}}), {}};
  QuadMesh plan = support::plan_of(*columns, 100);
  std::vector<char> is_on_feature(plan.points.size(), 0);
  for (const FeatureEdge& edge : plan.edges) is_on_feature[edge.a] = is_on_feature[edge.b] = 1;
  for (std::size_t p = 0; p < plan.points.size(); ++p)
    if (!is_on_feature[p]) plan.points[p] = plan.points[p] + Vec3{p % 3 * 16.0 - 16, p % 5 * 6.0 - 12, 0};
  Result<ExtrudedHexes> hexes = extrude_hexes(result.space, plan);
  EXPECT_TRUE(hexes);
  result.hexes = std::move(*hexes);
  return result;
}

TEST(SmoothHexes, raises_the_worst_cell_and_keeps_horizons_faults_and_sides) {
  Jittered model = jittered();
  const Result<HexSmoothing> smoothed = smooth_hexes(model.hexes, model.space, {10, 0.95});
  ASSERT_TRUE(smoothed);
  EXPECT_GT(smoothed->min_after, smoothed->min_before + 0.03);
  EXPECT_NEAR(smoothed->min_after, support::min_scaled_jacobian(model.hexes), 1e-12);
  EXPECT_GT(smoothed->moves, 100u);
  for (std::uint32_t e = 0; e < model.space.model.entities.size(); ++e)
    EXPECT_LE(support::furthest_from_entity_m(model.hexes.grid.mesh, model.space.model, e), 1e-6)
        << model.space.model.entities[e].name;
  support::expect_no_inverted_cell(model.hexes);
}

TEST(SmoothHexes, leaves_faults_alone_that_the_plan_does_not_follow) {
  Jittered model = jittered();
  QuadMesh& plan = model.hexes.grid.plan;
  std::erase_if(plan.edges, [&](const FeatureEdge& edge) { return plan.features[edge.feature].role == Role::fault; });
  const VolumeMesh before = model.hexes.grid.mesh;
  const Result<HexSmoothing> smoothed = smooth_hexes(model.hexes, model.space, {10, 0.95});
  ASSERT_TRUE(smoothed);
  EXPECT_GT(smoothed->moves, 100u);
  std::size_t on_faults = 0;
  for (const MeshFacet& facet : before.facets)
    if (model.space.model.entities[static_cast<std::size_t>(facet.surface)].role == Role::fault)
      for (const std::uint32_t v : facet.vertices)
        if (v != no_index) {
          ++on_faults;
          EXPECT_EQ(model.hexes.grid.mesh.points[v], before.points[v]);
        }
  EXPECT_GT(on_faults, 20u);
}

TEST(SmoothHexes, leaves_cells_alone_that_are_good_enough) {
  Jittered model = jittered();
  const std::vector<Vec3> before = model.hexes.grid.mesh.points;
  const Result<HexSmoothing> smoothed = smooth_hexes(model.hexes, model.space, {10, 0});
  ASSERT_TRUE(smoothed);
  EXPECT_EQ(smoothed->moves, 0u);
  EXPECT_EQ(model.hexes.grid.mesh.points, before);
}

TEST(SmoothHexes, flattens_warped_faces_and_lets_no_good_cell_fall_below_the_mark) {
  const auto columns = vertical_faults(1, false);
  Jittered model{support::upright(support::filled(*columns, 120), {2, {}, {}}), {}};
  model.hexes = *extrude_hexes(model.space, support::plan_of(*columns, 100));
  HexGrid& grid = model.hexes.grid;
  std::size_t moved = 0;
  for (std::size_t c = 0; c < grid.mesh.cell_count(); ++c) {
    const std::uint32_t v = grid.mesh.cell_vertices[8 * c + 4];  // inside a unit, over an inner point of the plan
    const Vec3 p = grid.mesh.points[v];
    if (grid.cell_layer[c] != 2 || std::abs(p.x - 1100) > 60 || std::abs(p.y - 600) > 60) continue;
    grid.mesh.points[v].x += 30;
    ++moved;
  }
  ASSERT_GE(moved, 1u);
  const Result<HexSmoothing> smoothed = smooth_hexes(model.hexes, model.space, {10, 0.6});
  ASSERT_TRUE(smoothed);
  EXPECT_GT(smoothed->warpage_before, 0.06);
  EXPECT_LE(smoothed->warpage_after, 0.05);
  EXPECT_GE(smoothed->min_after, std::min(smoothed->min_before, 0.6));
}

TEST(SmoothHexes, measures_how_far_a_face_is_warped) {
  std::array<Vec3, 8> cube{Vec3{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  EXPECT_EQ(face_warpage_m(cube), 0);
  cube[4].z += 0.2;
  cube[6].z += 0.2;
  EXPECT_NEAR(face_warpage_m(cube), 0.1, 1e-15);
}

TEST(SmoothHexes, measures_a_cube_and_its_mirror_image) {
  std::array<Vec3, 8> cube{Vec3{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  EXPECT_EQ(scaled_jacobian(cube), 1);
  for (Vec3& p : cube) p.z = -p.z;
  EXPECT_EQ(scaled_jacobian(cube), -1);
}

TEST(SmoothHexes, is_the_same_on_every_schedule) {
  const Jittered model = jittered();
  ExtrudedHexes expected = model.hexes;
  ASSERT_TRUE(smooth_hexes(expected, model.space, {3, 0.9}));
  support::on_every_schedule(
      [&](const char* schedule) {
        ExtrudedHexes hexes = model.hexes;
        ASSERT_TRUE(smooth_hexes(hexes, model.space, {3, 0.9}));
        EXPECT_EQ(hexes.grid.mesh.points, expected.grid.mesh.points) << schedule;
      },
      2);
}

TEST(SmoothHexes, refuses_options_without_sense) {
  Jittered model = jittered();
  EXPECT_FALSE(smooth_hexes(model.hexes, model.space, {-1, 0.5}));
  EXPECT_FALSE(smooth_hexes(model.hexes, model.space, {1, std::nan("")}));
}

}  // namespace
}  // namespace strataflow
