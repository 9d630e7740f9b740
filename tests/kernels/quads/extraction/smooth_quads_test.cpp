#include "kernels/quads/extraction/smooth_quads.h"

#include <gtest/gtest.h>

#include "kernels/quads/extraction/extract_quads.h"
#include "kernels/quads/extraction/map_samples.h"
#include "kernels/quads/extraction/quad_quality.h"
#include "kernels/quads/plan/plane_geometry.h"

namespace strataflow {
namespace {

using namespace map_samples;

/// Quads of a 12 × 8 rectangle with a fault, all points that may move displaced.
QuadMesh shaken(const MappedMesh& m, double by) {
  QuadMesh quads = *extract_quads(m.mesh, m.map);
  RandomStream random(5);
  for (Vec3& p : quads.points) {
    const bool at_side = p.x == 0 || p.x == 12 || p.y == 0 || p.y == 8;
    const double x = by * (random.unit() - 0.5), y = by * (random.unit() - 0.5);
    if (!at_side && p.y != 3) p = p + Vec3{x, y, 0};
  }
  return quads;
}

TEST(SmoothQuads, raises_the_worst_quad_and_leaves_features_alone) {
  const MappedMesh m = rectangle(12, 8, {line("a", Role::fault, {{2, 3, 0}, {9, 3, 0}})});
  QuadMesh quads = shaken(m, 1.2);
  const QuadQuality before = measure_quads(quads);
  const auto report = smooth_quads(quads, m.mesh);
  ASSERT_TRUE(report) << describe(report.failure());
  const QuadQuality after = measure_quads(quads);
  EXPECT_LT(before.scaled_jacobian.minimum, 0.2);
  EXPECT_GT(after.scaled_jacobian.minimum, 0.7);
  EXPECT_EQ(after.inverted, 0u);
  EXPECT_DOUBLE_EQ(report->after, after.scaled_jacobian.minimum);
  for (const FeatureEdge& e : quads.edges) {
    if (e.feature == 1) {
      EXPECT_NEAR(quads.points[e.a].y, 3, 1e-12);
    }
  }
  for (std::size_t i = 0; i < m.mesh.corners.size(); ++i)
    EXPECT_EQ(quads.points[quads.corner_points[i]], m.mesh.points[m.mesh.corners[i]]);
}

TEST(SmoothQuads, unfolds_quads_that_are_twisted_together) {
  const MappedMesh m = rectangle(12, 8, {});
  QuadMesh quads = *extract_quads(m.mesh, m.map);
  // A patch of 3 × 3 points turned by more than a right angle: no single move helps.
  for (Vec3& p : quads.points) {
    const Vec3 d = p - Vec3{6, 4, 0};
    if (std::max(std::abs(d.x), std::abs(d.y)) < 1.5)
      p = Vec3{6, 4, 0} + Vec3{-0.5 * d.x - 0.8 * d.y, 0.8 * d.x - 0.5 * d.y, 0};
  }
  const QuadQuality before = measure_quads(quads);
  ASSERT_GT(before.inverted, 3u);
  ASSERT_TRUE(smooth_quads(quads, m.mesh));
  EXPECT_EQ(measure_quads(quads).inverted, 0u);
  EXPECT_GT(measure_quads(quads).scaled_jacobian.minimum, 0.8);
}

TEST(SmoothQuads, points_slide_along_their_curve) {
  const MappedMesh m = rectangle(12, 8, {line("a", Role::fault, {{2, 3, 0}, {9, 3, 0}})});
  QuadMesh quads = *extract_quads(m.mesh, m.map);
  std::uint32_t slid = no_index;
  for (std::uint32_t p = 0; p < quads.points.size(); ++p)
    if (length(quads.points[p] - Vec3{5, 3, 0}) < 1e-6) slid = p;
  ASSERT_NE(slid, no_index);
  quads.points[slid].x = 5.9;
  ASSERT_TRUE(smooth_quads(quads, m.mesh));
  EXPECT_LT(quads.points[slid].x, 5.88);
  EXPECT_NEAR(quads.points[slid].y, 3, 1e-12);
}

TEST(SmoothQuads, keeps_to_a_surface_with_sharp_edges) {
  MappedMesh m = box_faces({4, 4, 4}, {0, 1, 2, 3, 5}, 7);
  QuadMesh quads = *extract_quads(m.mesh, m.map);
  RandomStream random(5);
  for (Vec3& p : quads.points)
    if (p.z == 4 && p.x > 0 && p.x < 4 && p.y > 0 && p.y < 4) p = p + Vec3{random.unit() - 0.5, random.unit() - 0.5, 0};
  const double before = measure_quads(quads).scaled_jacobian.minimum;
  ASSERT_TRUE(smooth_quads(quads, m.mesh));
  EXPECT_GT(measure_quads(quads).scaled_jacobian.minimum, std::max(0.6, before));
  for (const Vec3& p : quads.points) {
    const double away =
        std::min({std::abs(p.x), std::abs(p.x - 4), std::abs(p.y), std::abs(p.y - 4), std::abs(p.z - 4)});
    EXPECT_LT(away, 1e-9);
  }
}

TEST(QuadQuality, of_squares_is_perfect_and_a_bow_tie_counts_as_inverted) {
  const MappedMesh m = rectangle(3, 2, {});
  QuadMesh quads = *extract_quads(m.mesh, m.map);
  QuadQuality quality = measure_quads(quads);
  EXPECT_NEAR(quality.scaled_jacobian.minimum, 1, 1e-12);
  EXPECT_NEAR(quality.edge_length_m.mean(), 1, 1e-12);
  EXPECT_NEAR(quality.angle_deg.maximum, 90, 1e-6);
  EXPECT_EQ(quality.edge_length_m.count, 17u);
  EXPECT_EQ(quality.interior_irregular, 0u);
  EXPECT_EQ(quality.boundary_valence, (std::vector<std::uint64_t>{0, 4, 6}));
  std::swap(quads.quads[2][1], quads.quads[2][2]);
  quality = measure_quads(quads);
  EXPECT_EQ(quality.inverted, 1u);
  EXPECT_EQ(quality.worst_quad, 2u);
  EXPECT_LT(quality.scaled_jacobian.minimum, 0);
}

TEST(QuadQuality, the_scaled_jacobian_of_a_parallelogram_is_the_sine_of_its_angle) {
  const Vec3 a{0, 0, 0}, b{2, 0, 0}, c{2.5, 0.5, 0}, d{0.5, 0.5, 0};
  EXPECT_NEAR(smallest_scaled_jacobian(a, b, c, d, {0, 0, 1}), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(smallest_scaled_jacobian(a, d, c, b, {0, 0, 1}), -std::sqrt(0.5), 1e-12);
}

}  // namespace
}  // namespace strataflow
