#include "kernels/quads/extraction/subdivide_mesh.h"

#include <gtest/gtest.h>

#include "kernels/quads/extraction/check_quads.h"
#include "kernels/quads/extraction/map_samples.h"
#include "kernels/quads/extraction/quad_quality.h"

namespace strataflow {
namespace {

TEST(SubdivideMesh, makes_three_quads_of_each_triangle_and_keeps_features) {
  using namespace map_samples;
  const MappedMesh m = rectangle(8, 6, {line("a", Role::fault, {{2, 3, 0}, {6.3, 3.4, 0}})});
  const QuadMesh quads = subdivide_mesh(m.mesh);
  EXPECT_EQ(quads.quads.size(), 3 * m.mesh.triangles.size());
  const auto valid = check_quads(quads);
  EXPECT_TRUE(valid) << describe(valid.failure());
  EXPECT_EQ(euler_characteristic(quads.points.size(), quads.quads), 1);
  EXPECT_EQ(measure_quads(quads).inverted, 0u);
  EXPECT_EQ(quads.edges.size(), 2 * m.mesh.edges.size());
  double fault = 0;
  for (const FeatureEdge& e : quads.edges)
    if (e.feature == 1) fault += length(quads.points[e.a] - quads.points[e.b]);
  EXPECT_NEAR(fault, length(Vec3{4.3, 0.4, 0}), 1e-9);
}

TEST(CheckQuads, names_what_is_no_manifold) {
  QuadMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}};
  mesh.quads = {{0, 1, 2, 3}, {2, 4, 5, 6}};
  auto checked = check_quads(mesh);  // two squares that share a corner
  ASSERT_FALSE(checked);
  EXPECT_NE(checked.failure().what.find("boundary meets itself at (1.00, 1.00)"), std::string::npos)
      << checked.failure().what;
  mesh.points.resize(4);
  mesh.quads = {{0, 1, 2, 3}, {0, 1, 2, 3}};
  EXPECT_FALSE(check_quads(mesh));
  mesh.quads = {{0, 1, 2, 2}};
  EXPECT_FALSE(check_quads(mesh));
  mesh.quads = {{0, 1, 2, 3}};
  EXPECT_TRUE(check_quads(mesh));
  mesh.features = {{"a", Role::fault, 0, -1}};
  mesh.edges = {{0, 2, 0}};  // a diagonal
  checked = check_quads(mesh);
  ASSERT_FALSE(checked);
  EXPECT_NE(checked.failure().what.find("\"a\""), std::string::npos) << checked.failure().what;
}

TEST(FeatureChains, stop_at_corners_and_close) {
  const std::vector<FeatureEdge> edges{{0, 1, 0}, {1, 2, 0}, {2, 3, 0}, {4, 5, 1}, {4, 6, 1}, {5, 6, 1}};
  EXPECT_EQ(feature_chains(edges, {}, 0), (std::vector<std::vector<std::uint32_t>>{{0, 1, 2, 3}}));
  EXPECT_EQ(feature_chains(edges, {2}, 0), (std::vector<std::vector<std::uint32_t>>{{0, 1, 2}, {2, 3}}));
  EXPECT_EQ(feature_chains(edges, {2}, 1), (std::vector<std::vector<std::uint32_t>>{{4, 5, 6, 4}}));
}

}  // namespace
}  // namespace strataflow
