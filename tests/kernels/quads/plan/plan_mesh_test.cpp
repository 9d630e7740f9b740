#include "kernels/quads/plan/plan_mesh.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "kernels/quads/plan/generate_network.h"
#include "kernels/quads/plan/plan_samples.h"
#include "kernels/topology/building/edge_table.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

using namespace plan_samples;

TEST(PlanMesh, of_a_square_is_even_and_has_its_four_corners) {
  const auto mesh = plan_mesh(std::vector{square(100)}, {}, {}, edge(10));
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  EXPECT_TRUE(all_counter_clockwise(*mesh));
  EXPECT_NEAR(mesh_area(*mesh), 1e4, 1e-6);
  EXPECT_EQ(mesh->corners.size(), 4u);
  EXPECT_NEAR(feature_length(*mesh, "outline"), 400, 1e-9);
  EXPECT_GT(mesh->triangles.size(), 300u);
  EXPECT_LT(mesh->triangles.size(), 800u);
  for (const Triangle& t : mesh->triangles)
    for (int k = 0; k < 3; ++k) EXPECT_LT(length(mesh->points[t[k]] - mesh->points[t[(k + 1) % 3]]), 14);
}

TEST(PlanMesh, holds_faults_as_edges_with_ends_and_crossings_as_corners) {
  const auto mesh = plan_mesh(
      std::vector{square(100), fault("a", {{20, 30, 0}, {80, 60, 0}}), fault("b", {{50, 10, 0}, {50, 100, 0}})}, {}, {},
      edge(10));
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  EXPECT_NEAR(feature_length(*mesh, "a"), length(Vec3{60, 30, 0}), 1e-9);
  EXPECT_NEAR(feature_length(*mesh, "b"), 90, 1e-9);
  for (const Vec3& p : {Vec3{20, 30, 0}, Vec3{80, 60, 0}, Vec3{50, 10, 0}, Vec3{50, 100, 0}, Vec3{50, 45, 0}})
    EXPECT_TRUE(has_corner_at(*mesh, p)) << p.x << " " << p.y;
  EXPECT_EQ(mesh->corners.size(), 4u + 5);
}

TEST(PlanMesh, leaves_holes_out_and_drops_what_lies_outside) {
  const std::vector<Polyline> lines{square(100),
                                    line("h", Role::hole, {{40, 40, 0}, {60, 40, 0}, {60, 60, 0}, {40, 60, 0}}, true),
                                    fault("a", {{10, 50, 0}, {50, 50, 0}}), fault("b", {{80, 80, 0}, {140, 80, 0}}),
                                    fault("c", {{200, 0, 0}, {250, 0, 0}})};
  const auto mesh = plan_mesh(lines, {}, {}, edge(8));
  ASSERT_TRUE(mesh) << describe(mesh.failure());
  EXPECT_NEAR(mesh_area(*mesh), 1e4 - 400, 1e-6);
  EXPECT_NEAR(feature_length(*mesh, "a"), 30, 1e-9);
  EXPECT_NEAR(feature_length(*mesh, "b"), 20, 1e-9);
  EXPECT_EQ(feature_length(*mesh, "c"), 0);
  EXPECT_EQ(changes_of_kind(mesh->changes, "cut"), 3);
}

TEST(PlanMesh, fills_an_acute_corner_with_one_triangle) {
  for (const double deg : {2.0, 5.0, 20.0, 50.0}) {
    const double x = 40 * std::cos(deg * 0.017453292519943295), y = 40 * std::sin(deg * 0.017453292519943295);
    const auto mesh = plan_mesh(std::vector{square(100), fault("a", {{30, 50, 0}, {70, 50, 0}}),
                                            fault("b", {{30, 50, 0}, {30 + x, 50 + y, 0}})},
                                {}, {}, edge(10));
    ASSERT_TRUE(mesh) << describe(mesh.failure());
    const EdgeTable table = build_edge_table(mesh->points.size(), mesh->triangles);
    int filled = 0;
    for (std::uint32_t t = 0; t < mesh->triangles.size(); ++t) {
      std::vector<std::uint32_t> features;
      bool at_corner = false;
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        at_corner = at_corner || mesh->points[mesh->triangles[t][h % 3]] == Vec3{30, 50, 0};
        const auto& ends = table.edges[table.edge_of[h]];
        for (const FeatureEdge& e : mesh->edges)
          if (e.a == ends[0] && e.b == ends[1]) features.push_back(e.feature);
      }
      filled += at_corner && features.size() == 2;
    }
    EXPECT_EQ(filled, 1) << deg;
  }
}

TEST(PlanMesh, no_triangle_would_be_flattened_by_a_map_with_straight_features) {
  // A gently bent fault: no triangle has two of its edges, nor three of its points.
  std::vector<Vec3> bent;
  for (int i = 0; i <= 10; ++i) bent.push_back({10.0 + 8 * i, 50 + 15 * std::sin(0.6 * i), 0});
  const auto mesh = plan_mesh(std::vector{square(100), fault("a", bent)}, {}, {}, edge(10));
  ASSERT_TRUE(mesh);
  std::vector<char> on_fault(mesh->points.size(), 0);
  for (const FeatureEdge& e : mesh->edges)
    if (mesh->features[e.feature].name == "a") on_fault[e.a] = on_fault[e.b] = 1;
  for (const Triangle& t : mesh->triangles) EXPECT_LT(on_fault[t[0]] + on_fault[t[1]] + on_fault[t[2]], 3);
}

TEST(PlanMesh, a_free_boundary_is_no_feature) {
  PlanOptions options = edge(10);
  options.free_boundary = true;
  const auto mesh = plan_mesh(std::vector{square(100), fault("a", {{20, 30, 0}, {100, 60, 0}})}, {}, {}, options);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(feature_length(*mesh, "outline"), 0);
  EXPECT_EQ(mesh->corners.size(), 1u);
  EXPECT_TRUE(has_corner_at(*mesh, {20, 30, 0}));
}

TEST(PlanMesh, points_that_are_asked_for_are_corners_and_wells_are_circles) {
  const std::vector<PointSet> points{{"p", Role::points, {{33, 71, 4}, {50, 30.5, 0}}, {}},
                                     {"w", Role::well, {{70, 70, 0}}, {}}};
  const auto mesh = plan_mesh(std::vector{square(100), fault("a", {{20, 30, 0}, {80, 30, 0}})}, points, {}, edge(10));
  ASSERT_TRUE(mesh);
  EXPECT_TRUE(has_corner_at(*mesh, {33, 71, 0}));
  EXPECT_TRUE(has_corner_at(*mesh, {50, 30, 0}));
  EXPECT_NEAR(feature_length(*mesh, "w"), 2 * 10 * 12 * std::sin(3.14159265358979 / 12), 1e-9);
}

TEST(PlanMesh, has_the_same_bits_on_every_schedule) {
  const GeneratedNetwork network = generate_network(15);
  FeatureMesh reference;
  support::on_every_schedule([&](const char* schedule) {
    const auto mesh = plan_mesh(network.lines, network.point_sets, {}, edge(network.edge_length_m));
    ASSERT_TRUE(mesh);
    if (reference.points.empty()) reference = *mesh;
    EXPECT_EQ(mesh->points, reference.points) << schedule;
    EXPECT_EQ(mesh->triangles, reference.triangles) << schedule;
  });
}

/// R8.
TEST(PlanMesh, holds_every_curve_of_generated_networks_within_a_tenth_of_an_edge) {
  for (std::uint32_t index = 0; index < 3 * network_family_count; ++index) {
    const GeneratedNetwork network = generate_network(index);
    SCOPED_TRACE(network.name);
    const auto mesh = plan_mesh(network.lines, network.point_sets, {}, edge(network.edge_length_m));
    ASSERT_TRUE(mesh) << describe(mesh.failure());
    EXPECT_TRUE(all_counter_clockwise(*mesh));
    for (const Polyline& input : network.lines) {
      if (feature_length(*mesh, input.name) > 0) {
        EXPECT_LE(furthest_from_feature(*mesh, input), 0.1 * network.edge_length_m * (1 + 1e-9)) << input.name;
      }
    }
  }
}

TEST(GenerateNetwork, is_deterministic_and_varied) {
  EXPECT_EQ(generate_network(7).lines[1].points, generate_network(7).lines[1].points);
  EXPECT_NE(generate_network(7).lines[1].points, generate_network(17).lines[1].points);
  double sharpest = 90;
  std::size_t most = 0;
  for (std::uint32_t i = 0; i < 300; ++i) {
    const GeneratedNetwork network = generate_network(i);
    sharpest = std::min(sharpest, network.smallest_angle_deg);
    most = std::max(most, network.lines.size());
    EXPECT_GT(network.edge_length_m, 0);
  }
  EXPECT_LT(sharpest, 3);
  EXPECT_GE(most, 28u);
}

}  // namespace
}  // namespace strataflow
