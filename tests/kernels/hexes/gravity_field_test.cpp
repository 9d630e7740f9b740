#include "kernels/hexes/gravity_field.h"

#include <gtest/gtest.h>

#include "kernels/hexes/tet_models.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

LabelledTets tets_of(const ColumnModel& columns) {
  support::LevelledTets model = support::levelled(support::filled(columns, 120));
  separate_walls(model.tets, model.levels);
  return std::move(model.tets);
}

std::vector<Vec3> field_of(const LabelledTets& tets) { return gravity_field(tets, find_wall_sheets(tets)); }

TEST(GravityField, falls_straight_between_upright_walls) {
  for (const Vec3& g : field_of(tets_of(*vertical_faults(2, true)))) {
    EXPECT_NEAR(g.x, 0, 1e-6);
    EXPECT_NEAR(g.y, 0, 1e-6);
    EXPECT_EQ(g.z, -1);
  }
}

TEST(GravityField, is_tangent_to_faults_and_blends_between_them_and_the_sides) {  // R5
  const LabelledTets tets = tets_of(*dipping_faults(std::array{1.0}, 15));
  const std::vector<Vec3> field = field_of(tets);
  double least = 1, most = 0;
  for (std::uint32_t t = 0; t < field.size(); ++t) {
    least = std::min(least, field[t].x);
    most = std::max(most, field[t].x);
    for (std::uint32_t k = 0; k < 4; ++k)
      EXPECT_TRUE(!tets.has(4 * t + k, SheetKind::fault) || std::abs(field[t].x - 1) < 1e-9) << field[t].x;
  }
  EXPECT_NEAR(least, 0, 0.02);
  EXPECT_NEAR(most, 1, 0.02);
}

TEST(GravityField, runs_along_the_lines_where_walls_meet) {  // else what goes down a wall would fall into its corners
  const LabelledTets tets = tets_of(*dipping_faults(std::array{1.0}, 15));
  const WallSheets sheets = find_wall_sheets(tets);
  const std::vector<Vec3> field = gravity_field(tets, sheets);
  const std::vector<char> is_line = find_upright_lines(tets, sheets);
  std::size_t found = 0;
  for (const WallSheets::Wall& wall : sheets.walls)
    for (const std::uint32_t e : wall.edges) {
      if (!is_line[e]) continue;
      ++found;
      const Vec3 along = tets.points[sheets.edges[e].points[1]] - tets.points[sheets.edges[e].points[0]];
      for (const std::uint32_t t : wall.tets)
        if (t != no_index) {
          EXPECT_LT(length(cross(along, field[t])), 1e-9 * length(along));
        }
    }
  EXPECT_GT(found, 40u);  // four corners of the box and both ends of the fault
}

TEST(GravityField, is_the_same_on_every_schedule) {
  const LabelledTets tets = tets_of(*dipping_faults(std::array{1.0}, 15));
  const std::vector<Vec3> expected = field_of(tets);
  support::on_every_schedule([&](const char* schedule) { EXPECT_EQ(field_of(tets), expected) << schedule; });
}

}  // namespace
}  // namespace strataflow
