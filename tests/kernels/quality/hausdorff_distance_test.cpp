#include "kernels/quality/hausdorff_distance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/archive.h"
#include "graph/parallel/schedule.h"
#include "kernels/quality/curved_meshes.h"
#include "kernels/quality/topology_invariants.h"
#include "kernels/topology/building/build_structural_model.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

HausdorffDistance distance(const Mesh& a, const Mesh& b, double error_ratio = 1e-4) {
  return *hausdorff_distance({a.points, a.triangles}, {b.points, b.triangles}, {error_ratio});
}

TEST(HausdorffDistance, of_a_mesh_to_itself_is_zero_and_its_bound_the_allowed_error) {
  const Mesh mesh = sphere(3, 10);
  const HausdorffDistance result = distance(mesh, mesh);
  EXPECT_LT(result.distance_m(), 1e-14);  // but for rounding
  EXPECT_LE(result.bound_m(), 1e-4 * 6 * std::sqrt(3.0));
}

TEST(HausdorffDistance, between_a_sphere_and_an_offset_sphere_is_the_offset) {
  const Mesh inner = sphere(1, 40), outer = sphere(1.25, 40);
  const HausdorffDistance result = distance(inner, outer);
  EXPECT_NEAR(result.distance_m(), 0.25, 3e-3);  // facets lie up to 0.0019 inside their sphere
  EXPECT_LE(result.bound_m() - result.distance_m(), 1e-4 * 2.5 * std::sqrt(3.0) * 1.001);
  EXPECT_NEAR(result.ratio(), result.distance_m() / (2 * std::sqrt(3.0)), 1e-3);
}

TEST(HausdorffDistance, is_found_in_the_middle_of_a_triangle_far_from_every_vertex) {
  // A flat square against a shallow roof over its middle: vertices of the square are on the roof's eaves.
  const Mesh flat{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const Mesh roof{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 2, 1}, {4, 2, 1}},
                  {{0, 1, 5}, {0, 5, 4}, {4, 5, 2}, {4, 2, 3}}};
  const HausdorffDistance result = distance(flat, roof, 1e-6);
  const double expected = 2 * std::sin(std::atan(0.5));  // from the middle line to a pitch
  EXPECT_NEAR(result.forward.distance_m, expected, 1e-5);
  EXPECT_LE(result.forward.distance_m, expected + 1e-12);
  EXPECT_GE(result.forward.bound_m, expected - 1e-12);
  EXPECT_NEAR(result.forward.at.y, 2, 1e-4);
  EXPECT_NEAR(result.backward.distance_m, 1, 1e-15);  // a vertex of the ridge
}

TEST(HausdorffDistance, is_not_symmetric_but_its_maximum_is) {
  const Mesh whole = sphere(1, 12);
  Mesh half = whole;
  std::erase_if(half.triangles, [&](const Triangle& t) { return half.points[t[0]].z > 0; });
  const HausdorffDistance one = distance(half, whole), other = distance(whole, half);
  EXPECT_LT(one.forward.distance_m, 1e-15);
  EXPECT_GT(one.backward.distance_m, 0.5);
  EXPECT_EQ(one.forward.distance_m, other.backward.distance_m);
  EXPECT_EQ(one.distance_m(), other.distance_m());
}

TEST(HausdorffDistance, ranks_a_star_with_a_missing_side_best_and_only_topology_tells) {  // X17, Fig 2.8
  const std::vector<Vec3> contour = star(3, 1);
  const Mesh whole = ribbon(contour, true), broken = ribbon(contour, false);
  const Mesh tips = ribbon(star(3, 1, 0, 2), true), notches = ribbon(star(3, 1, 1, 2), true);
  const double missing = distance(whole, broken).distance_m();
  EXPECT_LT(missing, distance(whole, tips).distance_m());
  EXPECT_LT(missing, distance(whole, notches).distance_m());
  const double side = length(contour[1] - contour[0]), tip = 2 * std::asin(contour[1].y / side);
  EXPECT_NEAR(missing, side * std::sin(tip) / (1 + std::sin(tip)), 1e-3);
  EXPECT_EQ(topology_invariants(whole.triangles).euler(), 0);
  EXPECT_EQ(topology_invariants(tips.triangles).euler(), 0);
  EXPECT_EQ(topology_invariants(notches.triangles).euler(), 0);
  EXPECT_EQ(topology_invariants(broken.triangles).euler(), 1);
}

TEST(HausdorffDistance, is_the_same_on_every_schedule) {
  const Mesh a = sphere(1, 30), b = sphere(1.1, 23);
  std::vector<std::byte> expected;
  {
    const ScheduleScope serial(ScheduleKind::serial);
    expected = archived(distance(a, b));
  }
  for (const std::uint64_t seed : {1u, 2u}) {
    const ScheduleScope shuffled(ScheduleKind::shuffled, seed);
    EXPECT_EQ(archived(distance(a, b)), expected);
  }
  EXPECT_EQ(archived(distance(a, b)), expected);
}

TEST(HausdorffDistance, of_flat_meshes_that_share_no_vertex_takes_few_samples) {
  const auto sheet = [](std::uint32_t n) {
    Mesh mesh;
    for (std::uint32_t j = 0; j <= n; ++j)
      for (std::uint32_t i = 0; i <= n; ++i)
        mesh.points.push_back({static_cast<double>(i) / n, static_cast<double>(j) / n, 0});
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t at = j * (n + 1) + i;
        mesh.triangles.push_back({at, at + 1, at + n + 2});
        mesh.triangles.push_back({at, at + n + 2, at + n + 1});
      }
    return mesh;
  };
  const HausdorffDistance result = distance(sheet(30), sheet(37), 1e-6);
  RecordProperty("samples", static_cast<int>(result.forward.samples));
  EXPECT_LT(result.bound_m(), 2e-6);
  EXPECT_LT(result.forward.samples, 200'000u);  // bisection alone takes millions
}

TEST(HausdorffDistance, refuses_empty_meshes_and_senseless_errors) {
  const Mesh mesh = sphere(1, 4);
  EXPECT_EQ(hausdorff_distance({mesh.points, mesh.triangles}, {}).failure().code, FailureCode::invalid_input);
  EXPECT_EQ(hausdorff_distance({mesh.points, mesh.triangles}, {mesh.points, mesh.triangles}, {NAN}).failure().code,
            FailureCode::invalid_options);
}

TEST(HausdorffDistance, stops_when_asked_to) {
  const Mesh a = sphere(1, 12), b = sphere(1.01, 9);
  const auto stopped = hausdorff_distance({a.points, a.triangles}, {b.points, b.triangles}, {.is_cancelled = [] { return true; }});
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.failure().code, FailureCode::cancelled);
}

TEST(HausdorffDistance, of_30000_against_20000_triangles_keeps_its_bound) {
  const HausdorffDistance result = distance(sphere(1, 88), sphere(1.01, 71), 1e-3);
  EXPECT_NEAR(result.distance_m(), 0.01, 1e-3);
}

TEST(HausdorffByEntity, compares_features_of_the_same_name_and_names_those_that_are_gone) {
  const StructuralModel before = build_structural_model(support::layered_box({0, 0.25, 0.5, 1}))->model;
  TriangleSoup moved = support::layered_box({0, 0.25, 0.75, 1});
  moved.entities.back().name = "H9";
  const std::vector<EntityDistance> distances =
      *hausdorff_by_entity(before, build_structural_model(moved)->model);
  ASSERT_EQ(distances.size(), 4u);
  EXPECT_LT(distances[0].distance.distance_m(), 1e-15);  // the box
  EXPECT_EQ(distances[1].distance.distance_m(), 0);  // H1
  EXPECT_EQ(distances[2].name, "H2");
  EXPECT_TRUE(distances[2].is_missing);
  EXPECT_EQ(distances[3].name, "H9");
  EXPECT_TRUE(distances[3].is_missing);
}

TEST(HausdorffDistance, with_few_samples_says_how_much_it_may_have_missed) {
  // A ridge over a flat sheet of two triangles: no corner of the sheet sees it.
  const std::vector<Vec3> flat{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  std::vector<Vec3> ridged = flat;
  ridged.push_back({0.5, 0.3, 0.2});
  const std::vector<Triangle> two{{0, 1, 2}, {0, 2, 3}}, four{{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  const auto exact = hausdorff_distance({flat, two}, {ridged, four});
  const auto rough = hausdorff_distance({flat, two}, {ridged, four}, {.samples = 1});
  ASSERT_TRUE(exact && rough);
  EXPECT_LT(rough->forward.samples, exact->forward.samples);
  EXPECT_LE(rough->forward.distance_m, exact->forward.bound_m);
  EXPECT_GE(rough->forward.bound_m, exact->forward.distance_m);
  EXPECT_GT(rough->forward.bound_m - rough->forward.distance_m, exact->forward.bound_m - exact->forward.distance_m);
}

}  // namespace
}  // namespace strataflow
