#include "kernels/quads/plan/feature_mesh_of_surface.h"

#include <gtest/gtest.h>

#include "kernels/topology/building/build_structural_model.h"

namespace strataflow {
namespace {

/// Four sides and the top of a unit cube, every corner given once per triangle.
TriangleSoup open_cube() {
  const Vec3 c[8] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  const int quads[5][4] = {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}};
  TriangleSoup soup;
  for (int q = 0; q < 5; ++q)
    for (const std::array<int, 3>& t : {std::array<int, 3>{0, 1, 2}, std::array<int, 3>{0, 2, 3}}) {
      const auto first = static_cast<std::uint32_t>(soup.points.size());
      for (const int k : t) soup.points.push_back(c[quads[q][k]]);
      soup.triangles.push_back({first, first + 1, first + 2});
      soup.triangle_patch.push_back(q == 4 ? 1 : 0);
    }
  soup.patch_entity = {0, 1};
  soup.entities = {{"sides", Role::boundary}, {"top", Role::horizon}};
  return soup;
}

SurfaceFeatureOptions edge(double length_m) {
  SurfaceFeatureOptions options;
  options.edge_length_m = length_m;
  return options;
}

TEST(FeatureMeshOfSurface, finds_borders_sharp_edges_and_edges_between_entities) {
  const auto mesh = feature_mesh_of_surface(open_cube(), edge(5));
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  EXPECT_EQ(mesh->points.size(), 8u);
  std::map<std::string, int> count;
  for (const FeatureEdge& e : mesh->edges) ++count[mesh->features[e.feature].name];
  EXPECT_EQ(count, (std::map<std::string, int>{{"border of sides", 4}, {"sharp edges", 4}, {"sides | top", 4}}));
  EXPECT_EQ(mesh->corners.size(), 8u);
}

TEST(FeatureMeshOfSurface, halves_long_edges_and_keeps_features_whole) {
  const auto mesh = feature_mesh_of_surface(open_cube(), edge(0.2));
  ASSERT_TRUE(mesh);
  double border = 0;
  for (const FeatureEdge& e : mesh->edges)
    if (mesh->features[e.feature].name == "sharp edges") border += length(mesh->points[e.a] - mesh->points[e.b]);
  EXPECT_NEAR(border, 4, 1e-12);
  EXPECT_EQ(mesh->corners.size(), 8u);
  for (const Triangle& t : mesh->triangles)
    for (int k = 0; k < 3; ++k) EXPECT_LE(length(mesh->points[t[k]] - mesh->points[t[(k + 1) % 3]]), 0.2);
}

TEST(FeatureMeshOfSurface, orients_triangles_alike) {
  TriangleSoup soup = open_cube();
  std::swap(soup.triangles[3][0], soup.triangles[3][1]);
  const auto mesh = feature_mesh_of_surface(soup, edge(5));
  ASSERT_TRUE(mesh);
  for (const Triangle& t : mesh->triangles) {
    const Vec3 n = cross(mesh->points[t[1]] - mesh->points[t[0]], mesh->points[t[2]] - mesh->points[t[0]]);
    EXPECT_GT(dot(n, mesh->points[t[0]] - Vec3{0.5, 0.5, 0.4}), 0);
  }
}

TEST(FeatureMeshOfSurface, refuses_what_is_no_surface_and_says_where) {
  TriangleSoup fin = open_cube();
  const auto first = static_cast<std::uint32_t>(fin.points.size());
  for (const Vec3& p : {Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{0.5, -1, 2}}) fin.points.push_back(p);
  fin.triangles.push_back({first, first + 1, first + 2});
  fin.triangle_patch.push_back(0);
  auto refused = feature_mesh_of_surface(fin, edge(5));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.failure().what.find("more than two triangles"), std::string::npos);
  TriangleSoup flat = open_cube();
  flat.points[flat.triangles[0][2]] = flat.points[flat.triangles[0][1]];
  refused = feature_mesh_of_surface(flat, edge(5));
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.failure().what.find("no area"), std::string::npos);
  EXPECT_FALSE(feature_mesh_of_surface({}, edge(5)));
}

TEST(FeatureMeshOfModel, takes_lines_and_corners_of_the_model) {
  const StructuralModel model = build_structural_model(open_cube())->model;
  std::vector<std::uint32_t> tops;
  for (std::uint32_t s = 0; s < model.surfaces.size(); ++s)
    if (model.entities[model.surfaces[s].entity].name == "top") tops.push_back(s);
  const auto mesh = feature_mesh_of_model(model, tops, edge(0.3));
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  EXPECT_EQ(mesh->features.size(), 1u);
  EXPECT_EQ(mesh->features[0].name, "sides | top");
  EXPECT_EQ(mesh->corners.size(), 4u);
  EXPECT_FALSE(feature_mesh_of_model(model, std::vector<std::uint32_t>{99}, edge(0.3)));
}

}  // namespace
}  // namespace strataflow
