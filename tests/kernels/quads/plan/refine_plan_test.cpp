#include "kernels/quads/plan/refine_plan.h"

#include <gtest/gtest.h>

#include "kernels/adapters/cgal/constrained_delaunay.h"
#include "kernels/quads/plan/plan_samples.h"
#include "kernels/quads/plan/plane_triangulation.h"
#include "kernels/quads/plan/sample_plan.h"

namespace strataflow {
namespace {

PlaneTriangulation two_triangles() {
  return PlaneTriangulation({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}, {});
}

void expect_consistent(const PlaneTriangulation& mesh) {
  for (std::uint32_t h = 0; h < mesh.half_edge_count(); ++h) {
    const std::uint32_t g = mesh.opposite(h);
    if (g == no_index) continue;
    EXPECT_EQ(mesh.opposite(g), h);
    EXPECT_EQ(mesh.origin(g), mesh.target(h));
    EXPECT_EQ(mesh.target(g), mesh.origin(h));
    EXPECT_EQ(mesh.label(g), mesh.label(h));
  }
  for (const Triangle& t : mesh.triangles())
    EXPECT_GT(turn(mesh.points()[t[0]], mesh.points()[t[1]], mesh.points()[t[2]]), 0);
}

TEST(PlaneTriangulation, flips_and_splits_stay_consistent) {
  PlaneTriangulation mesh = two_triangles();
  EXPECT_TRUE(mesh.flip(2));
  expect_consistent(mesh);
  EXPECT_FALSE(mesh.flip(0) && mesh.opposite(0) == no_index);
  EXPECT_TRUE(mesh.split_triangle(
      0, (1.0 / 3) * (mesh.points()[mesh.origin(0)] + mesh.points()[mesh.target(0)] + mesh.points()[mesh.apex(0)])));
  expect_consistent(mesh);
  for (std::uint32_t h = 0; h < 6; ++h)
    mesh.split_edge(h, 0.5 * (mesh.points()[mesh.origin(h)] + mesh.points()[mesh.target(h)]));
  expect_consistent(mesh);
  EXPECT_EQ(mesh.points().size(), 11u);
}

TEST(PlaneTriangulation, refuses_a_point_outside_and_moves_that_turn_a_triangle) {
  PlaneTriangulation mesh = two_triangles();
  EXPECT_FALSE(mesh.split_triangle(0, {5, 5, 0}));
  EXPECT_FALSE(mesh.split_edge(0, {0.2, 0.9, 0}));
  ASSERT_TRUE(two_triangles().split_triangle(0, {0.6, 0.3, 0}));
  EXPECT_FALSE(mesh.move(2, {-1, -1, 0}));
  EXPECT_TRUE(mesh.move(2, {2, 1, 0}));
}

TEST(PlaneTriangulation, half_edges_go_around_a_point_from_the_boundary) {
  PlaneTriangulation mesh = two_triangles();
  const auto out = mesh.half_edges_from(0);
  ASSERT_EQ(out.size(), 2u);
  EXPECT_EQ(mesh.target(out[0]), 1u);
  EXPECT_EQ(mesh.target(out[1]), 2u);
}

TEST(SamplePlan, cuts_segments_finely_where_another_is_near) {
  PlanGraph graph;
  graph.points = {{0, 0, 0}, {100, 0, 0}, {40, 3, 0}, {60, 3, 0}};
  graph.is_required.assign(4, 0);
  graph.segments = {{0, 1, {0}, 10, {}}, {2, 3, {1}, 10, {}}};
  const auto plan = sample_plan(graph, 10);
  ASSERT_TRUE(plan);
  double near = 100, far = 0;
  for (const auto& piece : plan->pieces) {
    if (piece.segment != 0) continue;
    const Vec3 &a = plan->points[piece.ends[0]], &b = plan->points[piece.ends[1]];
    const double middle = 0.5 * (a.x + b.x);
    if (std::abs(middle - 50) < 5) near = std::min(near, length(b - a));
    if (middle < 20) far = std::max(far, length(b - a));
  }
  EXPECT_LT(near, 4.5);
  EXPECT_GT(far, 8);
}

TEST(RefinePlan, a_strip_gets_triangles_of_the_wanted_size_without_small_angles) {
  PlanGraph graph;
  graph.points = {{0, 0, 0}, {100, 0, 0}, {100, 40, 0}, {0, 40, 0}};
  graph.is_required.assign(4, 0);
  graph.segments = {{0, 1, {0}, 1, {}}, {1, 2, {0}, 1, {}}, {2, 3, {0}, 1, {}}, {0, 3, {0}, 1, {}}};
  auto plan = *sample_plan(graph, 5);
  std::vector<PlaneSegment> fixed;
  for (const auto& piece : plan.pieces) fixed.push_back(piece.ends);
  PlaneTriangulation mesh(plan.points, *constrained_delaunay(plan.points, fixed), fixed);
  ASSERT_TRUE(refine_plan(mesh, plan, 5));
  expect_consistent(mesh);
  EXPECT_EQ(plan.size_m.size(), mesh.points().size());
  for (const Triangle& t : mesh.triangles())
    for (int k = 0; k < 3; ++k) {
      const Vec3 &p = mesh.points()[t[k]], &q = mesh.points()[t[(k + 1) % 3]], &r = mesh.points()[t[(k + 2) % 3]];
      EXPECT_LT(length(p - q), 8);
      EXPECT_GT(std::atan2(cross(q - p, r - p).z, dot(q - p, r - p)), 0.35);
    }
  EXPECT_FALSE(refine_plan(mesh, plan, 0.5, 2000));
}

/// The centre lies on the diameters that the triangulation of such points has.
TEST(RefinePlan, a_circle_of_points_gets_its_centre) {
  PlanGraph graph;
  for (std::uint32_t i = 0; i < 12; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 12;
    graph.points.push_back({638 + 40 * std::cos(angle), 573 + 40 * std::sin(angle), 0});
    graph.segments.push_back({std::min(i, (i + 1) % 12), std::max(i, (i + 1) % 12), {0}, 30, {}});
  }
  graph.is_required.assign(12, 0);
  auto plan = *sample_plan(graph, 30);
  std::vector<PlaneSegment> fixed;
  for (const auto& piece : plan.pieces) fixed.push_back(piece.ends);
  PlaneTriangulation mesh(plan.points, *constrained_delaunay(plan.points, fixed), fixed);
  ASSERT_TRUE(refine_plan(mesh, plan, 30));
  expect_consistent(mesh);
  EXPECT_EQ(plan.size_m.size(), mesh.points().size());
  double nearest = 40;
  for (const Vec3& p : mesh.points()) nearest = std::min(nearest, length(p - Vec3{638, 573, 0}));
  EXPECT_LT(nearest, 10);
}

}  // namespace
}  // namespace strataflow
