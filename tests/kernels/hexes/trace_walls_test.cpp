#include "kernels/hexes/trace_walls.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "kernels/hexes/gravity_field.h"
#include "kernels/hexes/tet_models.h"

namespace strataflow {
namespace {

TEST(TraceWalls, leads_every_point_of_a_plane_fault_down_its_dip) {  // T4: weights are those of the projection
  support::LevelledTets model =
      support::levelled(support::filled(*dipping_faults(std::array{0.57735026918962576}, 15), 80));
  separate_walls(model.tets, model.levels);
  const LabelledTets& tets = model.tets;
  const WallSheets sheets = find_wall_sheets(tets);
  const TracedWalls traced = trace_walls(tets, sheets, gravity_field(tets, sheets));
  EXPECT_EQ(traced.stuck, 0u);
  std::size_t on_fault = 0;
  for (const UprightConstraint& c : traced.constraints) {
    if (tets.entities[sheets.sheet_entity[c.sheet]].name != "F1" || sheets.sheets_at(c.point).size() > 1) continue;
    const Vec3 foot = c.weight * tets.points[c.org] + (1 - c.weight) * tets.points[c.dest];
    ++on_fault;
    EXPECT_EQ(foot.z, 0);
    EXPECT_NEAR(foot.y, tets.points[c.point].y, 0.05);
  }
  EXPECT_GT(on_fault, 50u);
  for (const TracedWalls::LowerEdge& low : traced.lower_edges)
    for (const std::uint32_t p : sheets.edges[low.edge].points) EXPECT_EQ(tets.points[p].z, 0);
}

TEST(TraceWalls, leads_points_where_two_walls_meet_down_their_line) {
  const Result<LabelledTets> tets = label_tets(support::filled(*vertical_faults(2, true), 100));
  ASSERT_TRUE(tets);
  const WallSheets sheets = find_wall_sheets(*tets);
  const TracedWalls traced = trace_walls(*tets, sheets, std::vector<Vec3>(tets->tets.size(), Vec3{0, 0, -1}));
  std::size_t corners = 0;
  for (const UprightConstraint& c : traced.constraints) {
    const Vec3 foot = c.weight * tets->points[c.org] + (1 - c.weight) * tets->points[c.dest] - tets->points[c.point];
    EXPECT_LT(std::hypot(foot.x, foot.y), 1e-6);
    if (sheets.sheets_at(c.point).size() < 2) continue;
    ++corners;
    EXPECT_EQ(c.org, c.dest);
  }
  EXPECT_GT(corners, 10u);
}

TEST(TraceWalls, turns_no_triangle_of_a_side_over_beside_corners_and_faults) {
  support::LevelledTets model = support::levelled(support::filled(*dipping_faults(std::array{1.0}, 15), 60));
  split_wall_chords(model.tets, model.levels);
  separate_walls(model.tets, model.levels);
  const LabelledTets& tets = model.tets;
  const WallSheets sheets = find_wall_sheets(tets);
  TracedWalls traced = trace_walls(tets, sheets, gravity_field(tets, sheets));
  std::vector<UprightConstraint>& upwards = traced.constraints;
  std::sort(upwards.begin(), upwards.end(), [&](const UprightConstraint& a, const UprightConstraint& b) {
    return tets.points[a.point].z < tets.points[b.point].z;
  });
  std::vector<Vec3> feet = tets.points;
  for (const UprightConstraint& c : upwards) feet[c.point] = c.weight * feet[c.org] + (1 - c.weight) * feet[c.dest];
  std::size_t in_sides = 0;
  for (const WallSheets::Wall& wall : sheets.walls) {
    if (wall.tets[1] != no_index) continue;
    const auto turn = [&](const std::vector<Vec3>& places) {  // seen from the side: along it, and upwards
      std::array<Vec3, 3> p;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3& place = places[wall.vertices[k]];
        p[k] = {place.x + place.y, tets.points[wall.vertices[k]].z, 0};
      }
      return cross(p[1] - p[0], p[2] - p[0]).z;
    };
    ++in_sides;
    EXPECT_GT(turn(feet) * turn(tets.points), 0) << tets.points[wall.vertices[0]].x;
  }
  EXPECT_GT(in_sides, 500u);
}

}  // namespace
}  // namespace strataflow
