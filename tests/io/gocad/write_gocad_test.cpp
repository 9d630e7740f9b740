#include "io/gocad/write_gocad.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "io/gocad/read_gocad.h"
#include "io/input/local_origin.h"
#include "io/input_samples.h"

namespace strataflow {
namespace {

using ::testing::HasSubstr;

InputData read(const std::string& text, const std::string& name) {
  Result<InputData> input = read_gocad(text, name);
  EXPECT_TRUE(input) << (input ? "" : describe(input.failure()));
  return input ? std::move(*input) : InputData{};
}

/// Positions of all triangles of one entity, corner by corner, origin restored.
std::vector<Vec3> corners_of(const TriangleSoup& s, const std::string& entity) {
  std::vector<Vec3> corners;
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    if (s.entities[s.patch_entity[s.triangle_patch[t]]].name == entity)
      for (const std::uint32_t v : s.triangles[t]) corners.push_back(s.points[v] + s.local_origin);
  return corners;
}

void expect_equal_surfaces(const TriangleSoup& a, const TriangleSoup& b) {
  ASSERT_EQ(a.triangles.size(), b.triangles.size());
  for (const Entity& entity : a.entities)
    EXPECT_EQ(corners_of(a, entity.name), corners_of(b, entity.name)) << entity.name;
}

TEST(WriteGocadTs, what_was_read_and_shifted_is_written_back_bit_for_bit) {
  for (const char* name : {"gocad/two_layers.ml", "gocad/properties.ts"}) {
    InputData data = read(support::text_of(support::own_sample(name)), "in.ml");
    const InputData original = data;
    shift_to_local_origin(data);
    const InputData again = read(write_gocad_ts(data.surfaces), "out.ts");
    expect_equal_surfaces(original.surfaces, again.surfaces);
    EXPECT_EQ(again.surfaces.patch_entity.size(), original.surfaces.patch_entity.size());
    EXPECT_EQ(again.surfaces.border_stones.size(), original.surfaces.border_stones.size());
    EXPECT_EQ(again.surfaces.border_starts.size(), original.surfaces.border_starts.size());
    ASSERT_EQ(again.surfaces.properties.size(), original.surfaces.properties.size());
    for (std::size_t p = 0; p < original.surfaces.properties.size(); ++p) {
      EXPECT_EQ(again.surfaces.properties[p].name, original.surfaces.properties[p].name);
      EXPECT_EQ(again.surfaces.properties[p].width, original.surfaces.properties[p].width);
    }
  }
}

TEST(WriteGocadTs, names_are_made_unique_and_safe) {
  TriangleSoup s;
  s.points = {{0.1, 1e-300, 5e6}, {1, 0, 0}, {0, 1, 0}};
  s.triangles = {{0, 1, 2}, {0, 1, 2}, {0, 1, 2}, {0, 1, 2}};
  s.triangle_patch = {0, 1, 2, 3};
  s.patch_entity = {0, 1, 2, 3};
  s.entities = {{"a", Role::fault}, {"a", Role::horizon}, {" \n}", Role::unknown}, {"", Role::boundary}};
  const TriangleSoup again = read(write_gocad_ts(s), "out.ts").surfaces;
  ASSERT_EQ(again.entities.size(), 4u);
  EXPECT_EQ(again.entities[0].name, "a");
  EXPECT_EQ(again.entities[1].name, "a_2");
  EXPECT_EQ(again.entities[1].role, Role::horizon);
  EXPECT_EQ(again.entities[2].role, Role::unknown);
  EXPECT_EQ(again.entities[3].name, "surface");
  EXPECT_EQ(again.points[0].x, 0.1);
  EXPECT_EQ(again.points[0].y, 1e-300);
}

/// Two triangles of one fault that share an edge with a horizon; one region on either side.
StructuralModel small_model() {
  StructuralModel model;
  model.local_origin = {460000, 5937000, -2000};
  model.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.1, 0.2, 1}, {1, 1, 0}};
  model.triangles = {{0, 1, 2}, {1, 4, 2}, {1, 2, 3}};
  model.triangle_surface = {0, 1, 2};
  model.entities = {{"F1", Role::fault}, {"H1", Role::horizon}};
  model.corners = {{1}, {2}};
  Line line;
  line.vertices = {1, 2};
  line.corners = {0, 1};
  line.surfaces = {0, 1, 2};
  model.lines = {line};
  for (std::uint32_t s = 0; s < 3; ++s) {
    Surface surface;
    surface.entity = s == 2 ? 1 : 0;
    surface.first_triangle = s;
    surface.end_triangle = s + 1;
    surface.lines = {0};
    model.surfaces.push_back(surface);
  }
  model.surfaces[0].region_plus = 0;
  model.surfaces[1].region_minus = 1;
  model.regions = {{"upper", 0, {}, 1.0}, {"", 1, {}, 2.0}};
  model.layers = {{"layer 1", {0, 1}}};
  return model;
}

TEST(WriteGocadMl, a_model_reads_back_with_its_surfaces_regions_layers_and_borders) {
  const StructuralModel model = small_model();
  const InputData again = read(write_gocad_ml(model, "small"), "out.ml");
  const TriangleSoup& s = again.surfaces;
  EXPECT_TRUE(again.warnings.empty());
  ASSERT_EQ(s.entities.size(), 2u);
  EXPECT_EQ(s.entities[0].name, "F1");
  EXPECT_EQ(s.entities[0].role, Role::fault);
  EXPECT_EQ(s.entities[1].role, Role::horizon);
  EXPECT_EQ(s.patch_entity, (std::vector<std::uint32_t>{0, 0, 1})) << "patch = surface";
  EXPECT_EQ(s.triangle_patch, (std::vector<std::uint32_t>{0, 1, 2}));
  for (std::size_t t = 0; t < 3; ++t)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(s.points[s.triangles[t][k]], model.points[model.triangles[t][k]] + model.local_origin);
  ASSERT_EQ(s.regions.size(), 3u);
  EXPECT_EQ(s.regions[0].name, "Universe");
  EXPECT_EQ(s.regions[0].sides.size(), 4u);
  EXPECT_EQ(s.regions[1].name, "upper");
  ASSERT_EQ(s.regions[1].sides.size(), 1u);
  EXPECT_EQ(s.regions[1].sides[0].patch, 0u);
  EXPECT_EQ(s.regions[1].sides[0].is_positive, 1);
  EXPECT_EQ(s.regions[2].name, "region_2");
  EXPECT_EQ(s.regions[2].sides[0].is_positive, 0);
  ASSERT_EQ(s.layers.size(), 1u);
  EXPECT_EQ(s.layers[0].name, "layer 1");
  EXPECT_EQ(s.layers[0].regions, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(s.border_starts.size(), 3u) << "each surface along the line";
  EXPECT_EQ(s.border_stones.size(), 6u);
  for (const auto& [from, to] : s.border_starts) {
    EXPECT_EQ(s.points[from], model.points[1] + model.local_origin);
    EXPECT_EQ(s.points[to], model.points[2] + model.local_origin);
  }
}

TEST(WriteGocadMl, a_surface_of_several_entities_is_listed_under_each) {
  StructuralModel model = small_model();
  model.surfaces[1].all_entities = {0, 1};
  const InputData again = read(write_gocad_ml(model, "small"), "out.ml");
  EXPECT_TRUE(again.warnings.empty());
  EXPECT_EQ(again.surfaces.patch_entity, (std::vector<std::uint32_t>{0, 0, 1, 1}));
  EXPECT_EQ(corners_of(again.surfaces, "F1").size(), 6u);
  EXPECT_EQ(corners_of(again.surfaces, "H1").size(), 6u);
  const std::vector<PatchSide>& sides = again.surfaces.regions.at(2).sides;
  ASSERT_EQ(sides.size(), 1u);
  EXPECT_EQ(sides[0].patch, 1u) << "regions name it once";
}

TEST(WriteGocadTs, a_patch_of_several_entities_is_written_for_each) {
  TriangleSoup s;
  s.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  s.triangles = {{0, 1, 2}};
  s.triangle_patch = {0};
  s.patch_entity = {1};
  s.patch_other_entities = {{0}};
  s.entities = {{"H1", Role::horizon}, {"F1", Role::fault}};
  const TriangleSoup again = read(write_gocad_ts(s), "out.ts").surfaces;
  EXPECT_EQ(corners_of(again, "H1"), corners_of(again, "F1"));
  EXPECT_EQ(corners_of(again, "H1"), s.points);
}

TEST(WriteGocadSo, a_mesh_reads_back_with_its_regions_orientation_and_facets) {
  VolumeMesh mesh;
  mesh.local_origin = {460000, 5937000, -2000};
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  const std::uint32_t first[] = {0, 1, 2, 3};
  const std::uint32_t second[] = {1, 2, 3, 4};
  mesh.add_cell(CellType::tetrahedron, second, 1);
  mesh.add_cell(CellType::tetrahedron, first, 0);
  mesh.region_names = {"upper block", ""};
  mesh.entities = {{"unused", Role::fault}, {"contact", Role::horizon}};
  mesh.surface_entity = {1};
  mesh.facets = {{{1, 2, 3, no_index}, 0, 0, 1}};
  const Result<std::string> text = write_gocad_so(mesh, "mesh");
  ASSERT_TRUE(text);
  const InputData again = read(*text, "out.so");
  const VolumeMesh& v = again.volume;
  EXPECT_EQ(v.region_names, (std::vector<std::string>{"upper block", "region_2"}));
  EXPECT_EQ(v.cell_region, (std::vector<std::int32_t>{0, 1}));
  ASSERT_EQ(v.points.size(), 5u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(v.points[v.cell_vertices[k]], mesh.points[first[k]] + mesh.local_origin);
    EXPECT_EQ(v.points[v.cell_vertices[4 + k]], mesh.points[second[k]] + mesh.local_origin);
  }
  ASSERT_EQ(again.surfaces.entities.size(), 1u);
  EXPECT_EQ(again.surfaces.entities[0].name, "contact");
  EXPECT_EQ(again.surfaces.triangles.size(), 1u);
}

TEST(WriteGocadSo, other_cells_than_tetrahedra_are_refused) {
  VolumeMesh mesh;
  mesh.points.resize(5);
  const std::uint32_t v[] = {0, 1, 2, 3, 4};
  mesh.add_cell(CellType::pyramid, v, 0);
  EXPECT_EQ(write_gocad_so(mesh, "m").failure().code, FailureCode::unsupported);
}

TEST(WriteGocadRealModels, surfaces_of_cloudspin_survive_a_round_trip_bit_for_bit) {
  STRATAFLOW_NEEDS_SHARED_DATA();
  InputData data = read(support::text_of(support::shared_data() / "cloudspin/CloudSpin_fixed.ml"), "c.ml");
  const InputData original = data;
  shift_to_local_origin(data);
  EXPECT_NE(data.surfaces.local_origin.x, 0);
  expect_equal_surfaces(original.surfaces, read(write_gocad_ts(data.surfaces), "out.ts").surfaces);
}

}  // namespace
}  // namespace strataflow
