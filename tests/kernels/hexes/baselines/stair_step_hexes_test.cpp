#include "kernels/hexes/baselines/stair_step_hexes.h"

#include <gtest/gtest.h>

#include "base/archive.h"
#include "kernels/hexes/audit/audit_hexes.h"
#include "kernels/hexes/hex_checks.h"
#include "kernels/hexes/tet_models.h"
#include "kernels/simulation_grid/plan_blocks.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

ExtrudedHexes stairs(const LayeredSpace& space, double edge_m = 100) {
  Result<ExtrudedHexes> hexes = stair_step_hexes(space, edge_m);
  EXPECT_TRUE(hexes) << describe(hexes.failure());
  if (!hexes) return {};
  support::expect_no_inverted_cell(*hexes);
  EXPECT_TRUE(native_block(hexes->grid.plan, *opposite_half_edges(hexes->grid.plan)));
  for (const Vec3& p : hexes->grid.mesh.points) EXPECT_TRUE(is_finite(p));
  return *std::move(hexes);
}

HexAudit audited(const ExtrudedHexes& hexes, const LayeredSpace& space) {
  const Result<HexAudit> audit = audit_hexes(hexes.grid, space.model);
  EXPECT_TRUE(audit) << describe(audit.failure());
  return audit ? *audit : HexAudit{};
}

const LayeredSpace& one_fault() {
  static const LayeredSpace space = support::upright(support::filled(*vertical_faults(1, false), 80), {2, {}, {}});
  return space;
}

TEST(StairStepHexes, are_rectangular_columns_with_exact_horizons_where_there_is_no_fault) {
  const LayeredSpace space = support::upright(support::filled(*vertical_faults(0, false), 100), {2, {{"H1", 3}}, {}});
  const ExtrudedHexes hexes = stairs(space);
  EXPECT_EQ(hexes.grid.plan.quads.size(), 16u * 12);
  EXPECT_EQ(hexes.grid.mesh.cell_count(), 16u * 12 * 9);
  EXPECT_EQ(hexes.grid.mesh.points.size(), 17u * 13 * 10);
  support::expect_conforming(hexes.grid.mesh);
  for (const auto& quad : hexes.grid.plan.quads) {
    const auto& p = hexes.grid.plan.points;
    EXPECT_NEAR(dot(p[quad[1]] - p[quad[0]], p[quad[3]] - p[quad[0]]), 0, 1e-6);
  }
  for (std::uint32_t e = 0; e < space.model.entities.size(); ++e)
    EXPECT_LE(support::furthest_from_entity_m(hexes.grid.mesh, space.model, e), 1e-5) << space.model.entities[e].name;
  EXPECT_NEAR(support::volume_m3(hexes) / (1600.0 * 1200 * 400), 1, 1e-9);
}

TEST(StairStepHexes, pass_a_fault_between_columns_and_keep_horizons_away_from_it) {
  const ExtrudedHexes hexes = stairs(one_fault());  // the fault stands at x = 666.7, between pillars
  const HexAudit audit = audited(hexes, one_fault());
  EXPECT_LT(audit.furthest_from_horizons_m, 1e-5);
  EXPECT_EQ(audit.diagnosis.nonconforming_faces.elsewhere, 0u);
  EXPECT_GT(audit.diagnosis.nonconforming_faces.on_faults, 0u);
  for (const SurfaceAudit& surface : audit.surfaces) {
    if (surface.name != "F1") continue;
    EXPECT_EQ(surface.facets, 2u * 12 * 8);
    EXPECT_LE(surface.furthest_m, 50);
    EXPECT_GT(surface.furthest_m, 20);
  }
  EXPECT_NEAR(support::volume_m3(hexes) / (1600.0 * 1200 * 400), 1, 1e-9);
}

TEST(StairStepHexes, stand_on_faults_that_lean) {
  const std::array<double, 1> cot{1.0};
  const LayeredSpace space = support::upright(support::filled(*dipping_faults(cot, 40), 100), {2, {}, {}});
  const ExtrudedHexes hexes = stairs(space, 50);
  const HexAudit audit = audited(hexes, space);
  EXPECT_EQ(audit.inverted, 0u);
  EXPECT_EQ(audit.diagnosis.nonconforming_faces.elsewhere, 0u);
  // In every layer the step is where the fault is: faces lie at many columns.
  double low = 1e9, high = -1e9;
  for (const MeshFacet& facet : hexes.grid.mesh.facets) {
    if (hexes.grid.mesh.entities[facet.surface].name != "F1") continue;
    for (const std::uint32_t v : facet.vertices) {
      low = std::min(low, hexes.grid.mesh.points[v].x);
      high = std::max(high, hexes.grid.mesh.points[v].x);
    }
  }
  EXPECT_GT(high - low, 300);
  EXPECT_LT(audit.furthest_from_faults_m, 50);
}

TEST(StairStepHexes, close_cells_where_an_erosion_has_taken_the_layers) {
  const LayeredSpace space = support::upright(support::filled(*unconformity(false), 80), {2, {}, {}});
  const ExtrudedHexes hexes = stairs(space);
  const HexAudit audit = audited(hexes, space);
  EXPECT_GT(audit.dead, 50u);
  EXPECT_EQ(audit.misplaced, 0u);
  EXPECT_LT(audit.furthest_from_horizons_m, 1e-4);
}

TEST(StairStepHexes, are_the_same_on_every_schedule) {
  std::vector<std::byte> first;
  support::on_every_schedule([&](const char* schedule) {
    const Result<ExtrudedHexes> hexes = stair_step_hexes(one_fault(), 120);
    ASSERT_TRUE(hexes);
    const std::vector<std::byte> bytes = archived(*hexes);
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first) << schedule;
  });
}

TEST(StairStepHexes, refuse_edges_that_are_no_length) {
  for (const double edge_m : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    const Result<ExtrudedHexes> refused = stair_step_hexes(one_fault(), edge_m);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.failure().code, FailureCode::invalid_options);
  }
  const Result<ExtrudedHexes> many = stair_step_hexes(one_fault(), 1e-3);
  ASSERT_FALSE(many);
  EXPECT_EQ(many.failure().code, FailureCode::geometry_failed);
}

}  // namespace
}  // namespace strataflow
