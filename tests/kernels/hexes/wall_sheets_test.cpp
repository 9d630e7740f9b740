#include "kernels/hexes/wall_sheets.h"

#include <gtest/gtest.h>

#include "kernels/hexes/tet_models.h"

namespace strataflow {
namespace {

LabelledTets tets_of(const ColumnModel& columns, double edge_m, const std::vector<std::string>& dropped = {}) {
  Result<LabelledTets> tets = label_tets(support::filled(columns, edge_m), dropped);
  EXPECT_TRUE(tets) << describe(tets.failure());
  return std::move(*tets);
}

TEST(WallSheets, are_one_for_each_side_and_fault) {
  const LabelledTets tets = tets_of(*dipping_faults(std::array{0.577, 0.176}, 15), 100);
  const WallSheets sheets = find_wall_sheets(tets);
  EXPECT_EQ(sheets.sheet_entity.size(), 6u);
  EXPECT_TRUE(check_walls(tets, sheets));
  for (const WallSheets::Wall& wall : sheets.walls) {
    const bool is_fault = tets.facets[wall.facet].kind == SheetKind::fault;
    EXPECT_EQ(wall.tets[1] != no_index, is_fault);
  }
}

TEST(WallSheets, part_sides_of_one_entity_at_their_corners) {
  LabelledTets tets = tets_of(*dipping_faults(std::array{0.577}, 15), 100);
  const auto north = static_cast<std::uint32_t>(
      std::find_if(tets.entities.begin(), tets.entities.end(), [](const Entity& e) { return e.name == "North"; }) -
      tets.entities.begin());
  for (SheetFacet& facet : tets.facets)
    if (facet.kind == SheetKind::side) facet.entity = north;
  EXPECT_EQ(find_wall_sheets(tets).sheet_entity.size(), 5u);
}

TEST(WallSheets, refuse_a_fault_that_ends_downwards_on_a_side_by_name) {
  const LabelledTets tets = tets_of(*dipping_faults(std::array{4.0}, 5), 150);  // from the middle to the eastern side
  const WallSheets sheets = find_wall_sheets(tets);
  EXPECT_TRUE(check_walls(tets, sheets));
  // Told that a wall within 20° of horizontal is flat, it is.
  const Result<void> refused = check_walls(tets, sheets, 20);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.failure().code, FailureCode::unsupported);
  EXPECT_NE(refused.failure().what.find("F1"), std::string::npos);
  EXPECT_NE(refused.failure().remedy.find("drop_alignment"), std::string::npos);
}

TEST(WallSheets, refuse_the_wedge_of_a_y_by_name) {
  // The wall of a Y: F1 turned into two sheets of which one ends on the other along a flat line.
  LabelledTets tets = tets_of(*dipping_faults(std::array{0.577}, 0), 100);
  WallSheets sheets = find_wall_sheets(tets);
  const auto fault = static_cast<std::uint32_t>(
      std::find_if(sheets.sheet_entity.begin(), sheets.sheet_entity.end(),
                   [&](std::uint32_t e) { return tets.entities[e].name == "F1"; }) - sheets.sheet_entity.begin());
  for (WallSheets::Edge& edge : sheets.edges) {
    if (std::abs(tets.points[edge.points[0]].z - 400) > 1e-9 || std::abs(tets.points[edge.points[1]].z - 400) > 1e-9)
      continue;
    std::vector<std::uint32_t> on_fault;
    for (const std::uint32_t wall : edge.walls)
      if (sheets.walls[wall].sheet == fault) on_fault.push_back(wall);
    for (const std::uint32_t wall : on_fault) {  // a copy of the top row, turned upwards, in a sheet of its own
      WallSheets::Wall copy = sheets.walls[wall];
      for (std::uint32_t& v : copy.vertices)
        if (v != edge.points[0] && v != edge.points[1]) {
          tets.points.push_back(tets.points[v] + Vec3{0, 0, 2 * (400 - tets.points[v].z)});
          v = static_cast<std::uint32_t>(tets.points.size() - 1);
        }
      copy.sheet = 99;
      edge.walls.push_back(static_cast<std::uint32_t>(sheets.walls.size()));
      edge.walls.push_back(wall);  // the other side of the sheet it ends on
      sheets.walls.push_back(copy);
    }
  }
  sheets.sheet_entity.resize(100, sheets.sheet_entity[fault]);
  const Result<void> refused = check_walls(tets, sheets);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.failure().what.find("ends downwards on F1"), std::string::npos);
}

}  // namespace
}  // namespace strataflow
