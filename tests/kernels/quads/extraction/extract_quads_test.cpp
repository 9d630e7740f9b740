#include "kernels/quads/extraction/extract_quads.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "kernels/quads/extraction/check_quads.h"
#include "kernels/quads/extraction/map_samples.h"
#include "support/quad_chains.h"

namespace strataflow {
namespace {

using namespace map_samples;

std::map<std::uint32_t, int> valences_inside(const QuadMesh& quads) {
  const auto valence = quad_valence(quads);
  const auto boundary = boundary_points(quads);
  std::map<std::uint32_t, int> count;
  for (std::size_t p = 0; p < valence.size(); ++p)
    if (!boundary[p]) ++count[valence[p]];
  return count;
}

double length_of(const QuadMesh& quads, std::uint32_t feature) {
  double sum = 0;
  for (const FeatureEdge& e : quads.edges)
    if (e.feature == feature) sum += length(quads.points[e.a] - quads.points[e.b]);
  return sum;
}

TEST(ExtractQuads, the_identity_on_a_rectangle_gives_its_unit_squares) {
  const MappedMesh m = rectangle(5, 3, {});
  const auto quads = extract_quads(m.mesh, m.map);
  ASSERT_TRUE(quads) << describe(quads.failure());
  EXPECT_EQ(quads->quads.size(), 15u);
  EXPECT_EQ(quads->points.size(), 24u);
  EXPECT_EQ(quads->edges.size(), 16u);
  for (const Vec3& p : quads->points)
    EXPECT_NEAR(std::abs(p.x - std::round(p.x)) + std::abs(p.y - std::round(p.y)), 0, 1e-9);
  for (const auto& q : quads->quads)
    EXPECT_GT(cross(quads->points[q[1]] - quads->points[q[0]], quads->points[q[3]] - quads->points[q[0]]).z, 0.9);
}

TEST(ExtractQuads, faults_that_end_inside_and_cross_are_chains_of_edges) {
  MappedMesh m =
      rectangle(6, 5, {line("a", Role::fault, {{1, 2, 0}, {5, 2, 0}}), line("b", Role::fault, {{3, 1, 0}, {3, 5, 0}})});
  for (const std::uint64_t seed : {1, 2, 3}) {
    rechart(m, seed);
    const auto quads = extract_quads(m.mesh, m.map);
    ASSERT_TRUE(quads) << describe(quads.failure());
    EXPECT_EQ(quads->quads.size(), 30u);
    EXPECT_NEAR(length_of(*quads, 1), 4, 1e-12);
    EXPECT_NEAR(length_of(*quads, 2), 4, 1e-12);
    EXPECT_EQ(quads->corner_points.size(), m.mesh.corners.size());
    EXPECT_THAT(features_not_held(m.mesh, *quads), testing::IsEmpty());
  }
}

TEST(ExtractQuads, the_check_of_features_notices_a_label_that_is_gone_and_a_point_that_strays) {
  const MappedMesh m = rectangle(6, 5, {line("a", Role::fault, {{1, 2, 0}, {5, 2, 0}})});
  QuadMesh quads = *extract_quads(m.mesh, m.map);
  EXPECT_THAT(features_not_held(m.mesh, quads), testing::IsEmpty());
  QuadMesh strayed = quads;
  for (const FeatureEdge& e : quads.edges)
    if (e.feature == 1) strayed.points[e.a].y += 1e-6;
  EXPECT_FALSE(features_not_held(m.mesh, strayed).empty());
  quads.edges.erase(
      std::find_if(quads.edges.begin(), quads.edges.end(), [](const FeatureEdge& e) { return e.feature == 1; }));
  EXPECT_FALSE(features_not_held(m.mesh, quads).empty());
}

TEST(ExtractQuads, charts_turned_at_random_with_noise_change_nothing) {
  MappedMesh m = rectangle(4, 4, {line("a", Role::fault, {{1, 1, 0}, {3, 1, 0}})});
  const auto plain = extract_quads(m.mesh, m.map);
  ASSERT_TRUE(plain);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    rechart(m, seed, 1e-8);
    const auto quads = extract_quads(m.mesh, m.map);
    ASSERT_TRUE(quads) << seed << ": " << describe(quads.failure());
    EXPECT_EQ(quads->quads.size(), plain->quads.size());
    EXPECT_EQ(quads->edges.size(), plain->edges.size());
  }
}

TEST(ExtractQuads, an_open_box_is_a_disc_with_four_points_of_valence_three) {
  for (const int n : {1, 3, 5, 7}) {
    MappedMesh m = box_faces({2, 3, 4}, {0, 1, 2, 3, 5}, n);
    rechart(m, 7);
    const auto quads = extract_quads(m.mesh, m.map);
    ASSERT_TRUE(quads) << n << ": " << describe(quads.failure());
    EXPECT_EQ(quads->quads.size(), 2u * (12 + 8) + 6u);
    EXPECT_EQ(valences_inside(*quads)[3], 4);
    EXPECT_EQ(euler_characteristic(quads->points.size(), quads->quads), 1);
  }
}

TEST(ExtractQuads, a_closed_box_has_eight_points_of_valence_three) {
  MappedMesh m = box_faces({1, 1, 3}, {0, 1, 2, 3, 4, 5}, 4);
  rechart(m, 3);
  const auto quads = extract_quads(m.mesh, m.map);
  ASSERT_TRUE(quads) << describe(quads.failure());
  EXPECT_EQ(quads->quads.size(), 14u);
  EXPECT_EQ(valences_inside(*quads), (std::map<std::uint32_t, int>{{3, 8}, {4, 8}}));
}

TEST(ExtractQuads, a_tube_is_an_annulus_without_singular_points) {
  MappedMesh m = box_faces({2, 2, 3}, {0, 1, 2, 3}, 3);
  rechart(m, 11);
  const auto quads = extract_quads(m.mesh, m.map);
  ASSERT_TRUE(quads) << describe(quads.failure());
  EXPECT_EQ(quads->quads.size(), 24u);
  EXPECT_EQ(euler_characteristic(quads->points.size(), quads->quads), 0);
  EXPECT_EQ(quads->edges.size(), 16u);
}

/// R19.
TEST(ExtractQuads, valences_are_held_against_the_field) {
  MappedMesh m = box_faces({2, 2, 2}, {0, 1, 2, 3, 4, 5}, 2);
  m.map.valence.assign(m.mesh.points.size(), 4);
  const auto refused = extract_quads(m.mesh, m.map);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.failure().what.find("the field wants 4"), std::string::npos) << refused.failure().what;
  for (std::size_t p = 0; p < m.mesh.points.size(); ++p) {
    const Vec3& x = m.mesh.points[p];
    if (std::abs(x.x - 1) == 1 && std::abs(x.y - 1) == 1 && std::abs(x.z - 1) == 1) m.map.valence[p] = 3;
  }
  EXPECT_TRUE(extract_quads(m.mesh, m.map));
}

TEST(ExtractQuads, refuses_a_map_that_is_not_grid_preserving_and_says_where) {
  const MappedMesh good = rectangle(4, 3, {line("a", Role::fault, {{1, 1, 0}, {3, 1, 0}})});
  MappedMesh m = good;
  for (auto& uv : m.map.uv) uv = {1.3 * uv[0], uv[1]};  // the ends of the fault and the sides are off the grid
  auto refused = extract_quads(m.mesh, m.map);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.failure().what.find("needs one"), std::string::npos) << refused.failure().what;
  m = good;
  m.map.uv[10][0] = std::numeric_limits<double>::quiet_NaN();
  refused = extract_quads(m.mesh, m.map);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.failure().what.find("not finite"), std::string::npos) << refused.failure().what;
  m = good;
  for (auto& uv : m.map.uv) uv = {uv[0], -uv[1]};
  refused = extract_quads(m.mesh, m.map);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.failure().what.find("turns over"), std::string::npos) << refused.failure().what;
}

TEST(ExtractQuads, a_free_boundary_leaves_out_the_cells_it_cuts) {
  MappedMesh m = rectangle(5, 4, {});
  m.mesh.edges.clear();
  m.mesh.corners.clear();
  for (auto& uv : m.map.uv) {
    const std::complex<double> z = std::complex<double>(uv[0], uv[1]) * std::polar(1.0, 0.3);
    uv = {z.real(), z.imag()};
  }
  derive_turns_and_axes(m);
  const auto quads = extract_quads(m.mesh, m.map);
  ASSERT_TRUE(quads) << describe(quads.failure());
  EXPECT_GE(quads->quads.size(), 6u);
  EXPECT_LT(quads->quads.size(), 20u);
}

}  // namespace
}  // namespace strataflow
