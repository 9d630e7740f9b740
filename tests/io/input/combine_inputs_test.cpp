#include "io/input/combine_inputs.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strataflow {
namespace {

InputData one_triangle(const std::string& entity, Role role, double value) {
  InputData data;
  TriangleSoup& s = data.surfaces;
  s.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  s.triangles = {{0, 1, 2}};
  s.triangle_patch = {0};
  s.patch_entity = {0};
  s.entities = {{entity, role}};
  s.border_stones = {1};
  s.border_starts = {{{1, 2}}};
  PatchSide side;
  side.is_positive = 1;
  s.regions = {{"block", {side}}};
  s.layers = {{"layer", {0}}};
  s.properties = {{"throw", "m", 1, {value, value, value}}};
  return data;
}

TEST(CombineInputs, indices_of_later_parts_point_into_their_own_data) {
  const InputData all = *combine_inputs({one_triangle("F1", Role::fault, 1), one_triangle("F2", Role::fault, 2)});
  const TriangleSoup& s = all.surfaces;
  EXPECT_EQ(s.points.size(), 6u);
  EXPECT_EQ(s.triangles[1], (Triangle{3, 4, 5}));
  EXPECT_EQ(s.triangle_patch, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(s.patch_entity, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(s.border_stones, (std::vector<std::uint32_t>{1, 4}));
  EXPECT_EQ(s.border_starts[1], (std::array<std::uint32_t, 2>{4, 5}));
  EXPECT_EQ(s.regions[1].sides[0].patch, 1u);
  EXPECT_EQ(s.layers[1].regions[0], 1u);
  EXPECT_EQ(s.properties.at(0).values, (std::vector<double>{1, 1, 1, 2, 2, 2}));
}

TEST(CombineInputs, entities_merge_by_name_and_role_only) {
  const InputData all = *combine_inputs(
      {one_triangle("A", Role::fault, 1), one_triangle("A", Role::horizon, 1), one_triangle("A", Role::fault, 1)});
  EXPECT_EQ(all.surfaces.entities.size(), 2u);
  EXPECT_EQ(all.surfaces.patch_entity, (std::vector<std::uint32_t>{0, 1, 0}));
}

TEST(CombineInputs, further_entities_of_a_patch_follow_their_names) {
  InputData both = one_triangle("A", Role::fault, 1);
  both.surfaces.entities.push_back({"B", Role::fault});
  both.surfaces.patch_other_entities = {{1}};
  const InputData all = *combine_inputs({one_triangle("B", Role::fault, 1), both, one_triangle("C", Role::fault, 1)});
  EXPECT_EQ(all.surfaces.patch_entity, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(all.surfaces.patch_other_entities, (std::vector<std::vector<std::uint32_t>>{{}, {0}, {}}));
  EXPECT_EQ(all.surfaces.entities_of(1), (std::vector<std::uint32_t>{0, 1}));
}

TEST(CombineInputs, a_property_that_a_part_lacks_is_no_data_there) {
  InputData bare = one_triangle("B", Role::fault, 0);
  bare.surfaces.properties.clear();
  const InputData all = *combine_inputs({bare, one_triangle("A", Role::fault, 7), bare});
  const std::vector<double>& values = all.surfaces.properties.at(0).values;
  ASSERT_EQ(values.size(), 9u);
  EXPECT_TRUE(std::isnan(values[0]));
  EXPECT_EQ(values[3], 7);
  EXPECT_TRUE(std::isnan(values[8]));
}

TEST(CombineInputs, cells_and_their_regions_follow_one_another) {
  InputData part;
  part.volume.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::uint32_t v[] = {0, 1, 2, 3};
  part.volume.add_cell(CellType::tetrahedron, v, 0);
  part.volume.region_names = {"r"};
  part.volume.facets.push_back({{0, 1, 2, no_index}, 0, 0, no_index});
  part.volume.entities = {{"skin", Role::boundary}};
  part.volume.surface_entity = {0};
  InputData nameless = part;
  nameless.volume.region_names.clear();
  const VolumeMesh all = combine_inputs({part, nameless, part})->volume;
  EXPECT_EQ(all.cell_count(), 3u);
  EXPECT_EQ(all.cell_offsets, (std::vector<std::uint32_t>{0, 4, 8, 12}));
  EXPECT_EQ(all.cell_vertices[4], 4u);
  EXPECT_EQ(all.cell_region, (std::vector<std::int32_t>{0, 1, 2}));
  EXPECT_EQ(all.region_names, (std::vector<std::string>{"r", "", "r"}));
  EXPECT_EQ(all.facets[1].cell_0, 1u);
  EXPECT_EQ(all.facets[1].cell_1, no_index);
  EXPECT_EQ(all.facets[1].vertices[3], no_index);
  EXPECT_EQ(all.facets[1].surface, 1u);
  EXPECT_EQ(all.surface_entity, (std::vector<std::int32_t>{0, 0, 0}));
}

TEST(CombineInputs, nothing_combines_to_nothing) { EXPECT_TRUE(combine_inputs({})->surfaces.points.empty()); }

}  // namespace
}  // namespace strataflow
