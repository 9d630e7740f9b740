#include "kernels/hexes/verticalise.h"

#include <gtest/gtest.h>

#include "kernels/hexes/gravity_field.h"
#include "kernels/hexes/tet_models.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

using support::LevelledTets;

LevelledTets walled(const ColumnModel& columns, double edge_m, const std::vector<std::string>& drop_alignment = {}) {
  LevelledTets model = support::levelled(support::filled(columns, edge_m), drop_alignment);
  split_wall_chords(model.tets, model.levels);
  separate_walls(model.tets, model.levels);
  return model;
}

UprightPlan upright_plan(const LabelledTets& tets) {
  Result<UprightPlan> upright = verticalise(tets);
  EXPECT_TRUE(upright) << describe(upright.failure());
  return upright ? std::move(*upright) : UprightPlan{};
}

/// R2, R3: lower edges of the own sheet, weights in [0, 1], the constraint met, nothing turned over.
void expect_upright(const LabelledTets& tets, const UprightPlan& upright) {
  const double diagonal_m = 2300;
  for (const UprightConstraint& c : upright.traced.constraints) {
    EXPECT_GE(c.weight, 0);
    EXPECT_LE(c.weight, 1);
    const Vec3 off = c.weight * upright.plan[c.org] + (1 - c.weight) * upright.plan[c.dest] - upright.plan[c.point];
    EXPECT_LE(length(off), 1e-9 * diagonal_m);
    const double below = c.weight * tets.points[c.org].z + (1 - c.weight) * tets.points[c.dest].z;
    EXPECT_LT(below, tets.points[c.point].z);
  }
  EXPECT_EQ(upright.traced.stuck, 0u);
  EXPECT_GT(upright.smallest_determinant, 0);
  // Every point of every wall has a constraint or lies on a lower edge.
  std::vector<char> is_held(tets.points.size(), 0);
  for (const UprightConstraint& c : upright.traced.constraints) is_held[c.point] = 1;
  for (const auto& low : upright.traced.lower_edges)
    for (const std::uint32_t p : upright.sheets.edges[low.edge].points) is_held[p] = 1;
  for (const WallSheets::Wall& wall : upright.sheets.walls)
    for (const std::uint32_t p : wall.vertices) EXPECT_TRUE(is_held[p]) << p;
}

TEST(Verticalise, leaves_a_model_alone_whose_faults_stand_upright) {
  const LevelledTets model = walled(*vertical_faults(4, true), 100);
  const UprightPlan upright = upright_plan(model.tets);
  EXPECT_TRUE(upright.is_identity);
  for (std::size_t p = 0; p < upright.plan.size(); ++p) {
    EXPECT_EQ(upright.plan[p].x, model.tets.points[p].x);
    EXPECT_EQ(upright.plan[p].y, model.tets.points[p].y);
  }
}

TEST(Verticalise, sets_a_plane_fault_of_60_degrees_upright) {
  const LevelledTets model = walled(*dipping_faults(std::array{0.57735026918962576}, 15), 80);
  const UprightPlan upright = upright_plan(model.tets);
  EXPECT_FALSE(upright.is_identity);
  expect_upright(model.tets, upright);
  // The field follows the dip on the fault (R5); all of the fault's points come to lie on one line north.
  const std::vector<Vec3> field = gravity_field(model.tets, upright.sheets);
  for (const WallSheets::Wall& wall : upright.sheets.walls) {
    const auto& [a, b, c] = wall.vertices;
    Vec3 n = cross(model.tets.points[b] - model.tets.points[a], model.tets.points[c] - model.tets.points[a]);
    n = (1 / length(n)) * n;
    for (const std::uint32_t t : wall.tets)
      if (t != no_index) {
        EXPECT_NEAR(dot(n, field[t]), 0, 1e-9);
      }
  }
  double west = 1e9, east = -1e9;
  for (const WallSheets::Wall& wall : upright.sheets.walls)
    if (model.tets.entities[upright.sheets.sheet_entity[wall.sheet]].name == "F1")
      for (const std::uint32_t p : wall.vertices) {
        west = std::min(west, upright.plan[p].x);
        east = std::max(east, upright.plan[p].x);
      }
  EXPECT_LT(east - west, 10);  // 231 m in space
}

TEST(Verticalise, sets_faults_of_80_to_45_degrees_upright) {
  const LevelledTets model = walled(*dipping_faults(std::array{0.17632698070846498, 0.57735026918962576, 1.0}, 15), 60);
  expect_upright(model.tets, upright_plan(model.tets));
}

TEST(Verticalise, sets_a_listric_fault_upright_without_turning_anything_over) {
  const LevelledTets model = walled(*listric_fault(), 60);
  const UprightPlan upright = upright_plan(model.tets);
  EXPECT_GT(upright.flipped_by_linear, 0u);
  EXPECT_GT(upright.untangling_steps, 0u);
  expect_upright(model.tets, upright);
}

TEST(Verticalise, is_the_same_on_every_schedule) {
  const LevelledTets model = walled(*listric_fault(), 150);
  const UprightPlan expected = upright_plan(model.tets);
  support::on_every_schedule(
      [&](const char* schedule) { EXPECT_EQ(upright_plan(model.tets).plan, expected.plan) << schedule; });
}

}  // namespace
}  // namespace strataflow
