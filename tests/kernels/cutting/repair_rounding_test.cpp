#include "kernels/cutting/repair_rounding.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace strataflow {
namespace {

CutMesh mesh_of(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
  CutMesh mesh{points, triangles, {}, std::vector<char>(triangles.size(), 0)};
  for (std::uint32_t t = 0; t < triangles.size(); ++t) mesh.origin.push_back(t);
  return mesh;
}

RoundingRepair repaired(CutMesh& mesh, double reach) {
  const RoundingRepair done = repair_rounding(mesh, find_intersections(mesh.points, mesh.triangles), reach);
  EXPECT_EQ(mesh.origin.size(), mesh.triangles.size());
  EXPECT_EQ(mesh.is_changed.size(), mesh.triangles.size());
  return done;
}

const double small = 1e-12;

TEST(RepairRounding, joins_vertices_in_reach) {
  CutMesh mesh =
      mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-small, small, -small}, {0, 0, 1}, {1, 1, 1}, {0.5, 0.2, -1}},
              {{0, 1, 2}, {3, 4, 5}, {3, 5, 6}});
  mesh.input_point_count = 3;
  ASSERT_FALSE(find_intersections(mesh.points, mesh.triangles).empty());
  const RoundingRepair done = repaired(mesh, 1e-11);
  EXPECT_EQ(done.merged_points, 1u);
  EXPECT_NEAR(done.largest_move_m, std::sqrt(3.0) * small, 1e-15);
  EXPECT_EQ(mesh.triangles[1], (Triangle{0, 4, 5})) << "the input point stays";
}

TEST(RepairRounding, leads_an_edge_through_a_vertex_in_reach_in_all_its_triangles) {
  // The tip of the third touches the edge 0–1 of the first two, a little past it.
  CutMesh mesh =
      mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0.5, small, small}, {0.5, 0.2, -1}, {0.5, -0.2, -1}},
              {{0, 1, 2}, {1, 0, 3}, {4, 5, 6}});
  ASSERT_FALSE(find_intersections(mesh.points, mesh.triangles).empty());
  const RoundingRepair done = repaired(mesh, 1e-11);
  EXPECT_EQ(done.split_edges, 1u);
  EXPECT_EQ(mesh.triangles.size(), 5u);
  EXPECT_EQ(std::count(mesh.origin.begin(), mesh.origin.end(), 0u), 2);
  EXPECT_EQ(std::count(mesh.origin.begin(), mesh.origin.end(), 1u), 2);
  EXPECT_TRUE(find_intersections(mesh.points, mesh.triangles).empty());
}

TEST(RepairRounding, splits_the_longest_edge_of_a_sliver_so_that_slivers_do_not_flip_to_and_fro) {
  // Points 0, 1, 2, 3 lie along a line but for rounding. Between its long edge 0–3 and the chain are two slivers, on
  // the chain stand two triangles of another surface, and triangle 4 is the sliver's neighbour.
  CutMesh mesh = mesh_of({{0, 0, 0}, {1, 0.25 * small, small}, {2, small, 0}, {3, 0, 0}, {1.5, 0.3, -4}, {1.5, -4, 0}},
                         {{0, 2, 1}, {0, 3, 2}, {2, 1, 4}, {4, 1, 0}, {3, 0, 5}});
  ASSERT_FALSE(find_intersections(mesh.points, mesh.triangles).empty());
  EXPECT_GT(repaired(mesh, 1e-11).split_edges, 0u);
  const auto has_edge = [&](std::uint32_t a, std::uint32_t b) {
    return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
      return std::count(t.begin(), t.end(), a) + std::count(t.begin(), t.end(), b) == 2;
    });
  };
  EXPECT_FALSE(has_edge(0, 3));
  EXPECT_EQ(std::count(mesh.origin.begin(), mesh.origin.end(), 4u), 2) << "the neighbour gets the vertex too";
}

TEST(RepairRounding, leads_a_triangle_through_a_vertex_in_reach) {
  CutMesh mesh =
      mesh_of({{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {1, 1, small}, {1, 1.1, -1}, {1, 0.9, -1}}, {{0, 1, 2}, {3, 4, 5}});
  ASSERT_FALSE(find_intersections(mesh.points, mesh.triangles).empty());
  const RoundingRepair done = repaired(mesh, 1e-11);
  EXPECT_EQ(done.split_triangles, 1u);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_TRUE(find_intersections(mesh.points, mesh.triangles).empty());
}

TEST(RepairRounding, leaves_alone_what_is_out_of_reach) {
  CutMesh mesh =
      mesh_of({{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {1, 1, 1}, {1, 1.1, -1}, {1, 0.9, -1}}, {{0, 1, 2}, {3, 4, 5}});
  const auto before = mesh.triangles;
  EXPECT_FALSE(repaired(mesh, 1e-11).did_anything());
  EXPECT_EQ(mesh.triangles, before);
}

}  // namespace
}  // namespace strataflow
