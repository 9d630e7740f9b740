#include "kernels/drawing/build_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "kernels/drawing/palette.h"
#include "kernels/quality/two_layers.h"

namespace strataflow {
namespace {

TEST(SceneOfModel, shows_every_triangle_in_the_colour_of_its_entity_and_knows_what_is_outside) {
  const TwoLayers layers;
  const Scene scene = scene_of_model(layers.model, ColourBy::entity);
  ASSERT_EQ(scene.triangles.size(), layers.model.triangles.size());
  ASSERT_EQ(scene.legend.size(), 3u);
  EXPECT_EQ(scene.legend[2].name, "interface");
  EXPECT_EQ(scene.legend[2].colour, categorical_colour(2));
  for (std::uint32_t s = 0; s < 3; ++s)
    for (std::uint32_t t = layers.model.surfaces[s].first_triangle; t < layers.model.surfaces[s].end_triangle; ++t) {
      EXPECT_EQ(scene.triangles[t].front_colour, s);
      EXPECT_EQ(scene.triangles[t].outside, s == 2 ? 0 : 1);
    }
}

TEST(SceneOfModel, by_region_a_wall_has_the_colour_of_the_region_behind_it) {
  const TwoLayers layers;
  const Scene scene = scene_of_model(layers.model, ColourBy::region);
  ASSERT_EQ(scene.legend.size(), 2u);
  EXPECT_EQ(scene.legend[0].name, "below");
  const SceneTriangle& wall = scene.triangles[layers.model.surfaces[1].first_triangle];
  EXPECT_EQ(wall.front_colour, 1u);  // from outside, and from inside alike
  EXPECT_EQ(wall.back_colour, 1u);
  const SceneTriangle& interface = scene.triangles[layers.model.surfaces[2].first_triangle];
  EXPECT_EQ(interface.front_colour, 0u);  // from above: the region below
  EXPECT_EQ(interface.back_colour, 1u);
}

TEST(SceneOfExplodedRegions, moves_each_region_away_from_the_middle) {
  TwoLayers layers;
  layers.model.frontiers = {{{{0, 0}, {2, 0}}, 0, 1, 4}, {{{1, 0}, {2, 1}}, 1, 1, 4}};
  layers.model.lines.resize(1);
  layers.model.lines[0].vertices = {9, 10, 11};
  layers.model.lines[0].corners = {0, 1};  // open: two segments
  for (Surface& surface : layers.model.surfaces) surface.lines = {0};
  const Scene scene = scene_of_exploded_regions(layers.model, 0.5);
  double lowest = 1e9, highest = -1e9;
  for (const Vec3& p : scene.points) lowest = std::min(lowest, p.z), highest = std::max(highest, p.z);
  EXPECT_DOUBLE_EQ(lowest, -0.25);
  EXPECT_DOUBLE_EQ(highest, 2.25);
  const std::size_t interface = layers.model.surfaces[2].end_triangle - layers.model.surfaces[2].first_triangle;
  EXPECT_EQ(scene.triangles.size(), layers.model.triangles.size() + interface);  // the interface is drawn twice
  EXPECT_EQ(scene.lines.size(), 4u);
}

TEST(SceneOfVolumeMesh, shows_the_outer_faces_and_a_bold_line_between_regions) {
  const VolumeMesh mesh = box_mesh(2, 2, 2, 1, false);
  const Scene scene = scene_of_volume_mesh(mesh);
  EXPECT_EQ(scene.triangles.size(), 24u * 2);
  EXPECT_EQ(scene.legend.size(), 2u);
  EXPECT_EQ(scene.lines.size(), 8u);  // around the box at z = 1
  for (const auto& line : scene.lines) EXPECT_EQ(scene.points[line[0]].z, 1);
  for (const SceneTriangle& t : scene.triangles) EXPECT_TRUE(t.mesh_edges == 3 || t.mesh_edges == 6);
}

TEST(SceneOfVolumeMesh, a_cut_takes_away_the_cells_beyond_it_and_shows_the_ones_inside) {
  const VolumeMesh mesh = box_mesh(4, 2, 2, 1, false);
  const Scene scene = scene_of_volume_mesh(mesh, CutPlane{{1.2, 0, 0}, {1, 0, 0}});  // centroids at 0.5, 1.5 …
  double farthest = 0;
  for (const Vec3& p : scene.points) farthest = std::max(farthest, p.x);
  EXPECT_EQ(farthest, 1);
  EXPECT_EQ(scene.triangles.size(), 2u * (4 + 4 + 4 * 2));
}

TEST(SceneOfVolumeMesh, without_regions_the_cell_types_are_coloured) {
  VolumeMesh mesh = box_mesh(1, 1, 1, 1, false);
  mesh.cell_region.clear();
  const Scene scene = scene_of_volume_mesh(mesh);
  ASSERT_EQ(scene.legend.size(), 1u);
  EXPECT_EQ(scene.legend[0].name, "hexahedra");
}

TEST(SceneOfVolumeMesh, the_rims_of_named_surfaces_are_bold_where_they_are_seen) {
  const TwoLayers layers;
  VolumeMesh mesh = layers.mesh;
  std::fill(mesh.cell_region.begin(), mesh.cell_region.end(), 0);  // so that only the facets tell
  EXPECT_EQ(scene_of_volume_mesh(mesh).lines.size(), 8u);
}

TEST(MiddleCut, opens_the_half_towards_the_eye) {
  const VolumeMesh mesh = box_mesh(4, 2, 2, 1, false);
  EXPECT_EQ(middle_cut(mesh, -60).normal, (Vec3{0, -1, 0}));
  EXPECT_EQ(middle_cut(mesh, 10).normal, (Vec3{1, 0, 0}));
  EXPECT_EQ(middle_cut(mesh, 10).point, (Vec3{2, 1, 1}));
}

TEST(CategoricalColour, the_first_forty_eight_are_all_different) {
  std::set<std::uint32_t> seen;
  for (std::size_t i = 0; i < 48; ++i) {
    const Colour c = categorical_colour(i);
    seen.insert(c.red << 16 | c.green << 8 | c.blue);
  }
  EXPECT_EQ(seen.size(), 48u);
}

}  // namespace
}  // namespace strataflow
