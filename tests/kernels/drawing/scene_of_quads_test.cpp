#include "kernels/drawing/scene_of_quads.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

/// Three quads around one point.
QuadMesh corner_of_a_cube() {
  QuadMesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {1, 2, 0}, {-1, 2, 0}, {-2, 0, 0}, {-1, -2, 0}, {1, -2, 0}};
  mesh.quads = {{0, 1, 2, 3}, {0, 3, 4, 5}, {0, 5, 6, 1}};
  mesh.features = {{.name = "F1", .role = Role::fault}};
  mesh.edges = {{0, 3, 0}};
  return mesh;
}

FeatureMesh two_triangles() {
  FeatureMesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

TEST(SceneOfQuads, colours_the_quads_around_an_irregular_vertex_and_draws_features) {
  const Scene scene = scene_of_quads(corner_of_a_cube());
  ASSERT_EQ(scene.triangles.size(), 6u);
  for (const SceneTriangle& triangle : scene.triangles)
    EXPECT_EQ(scene.legend[triangle.front_colour].name, "around three quads' vertex");
  EXPECT_EQ(scene.lines, (std::vector<std::array<std::uint32_t, 2>>{{0, 3}}));
  QuadMesh one = corner_of_a_cube();
  one.quads.resize(1);
  EXPECT_EQ(scene_of_quads(one).triangles[0].front_colour, 0u) << "on the boundary nothing is irregular";
}

TEST(SceneOfMap, draws_the_lines_of_whole_numbers) {
  const FeatureMesh mesh = two_triangles();
  CornerMap map;
  map.uv = {{0.5, 0.5}, {2.5, 0.5}, {2.5, 2.5}, {0.5, 0.5}, {2.5, 2.5}, {0.5, 2.5}};
  const Scene scene = scene_of_map(mesh, map);
  EXPECT_EQ(scene.lines.size(), 8u) << "u = 1, u = 2, v = 1, v = 2 in each triangle";
  for (const auto& [a, b] : scene.lines)
    EXPECT_TRUE(scene.points[a].x == scene.points[b].x || scene.points[a].y == scene.points[b].y);
}

TEST(SceneOfField, draws_a_cross_in_every_triangle) {
  const FeatureMesh mesh = two_triangles();
  FrameField field;
  field.angles = {{0, 1.5707963267948966}, {0, 1.5707963267948966}};
  field.valence = {4, 4, 3, 4};
  const Scene scene = scene_of_field(mesh, field);
  EXPECT_EQ(scene.lines.size(), 4u);
  EXPECT_EQ(scene.legend[scene.triangles[0].front_colour].name, "around three quads' vertex");
  const auto [a, b] = scene.lines[0];
  EXPECT_NEAR(scene.points[a].y, scene.points[b].y, 1e-12) << "along the first half-edge";
}

}  // namespace
}  // namespace strataflow
