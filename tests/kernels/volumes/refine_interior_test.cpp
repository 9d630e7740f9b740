#include "kernels/volumes/refine_interior.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/volumes/tet_faces.h"
#include "model/volume_mesh.h"

namespace strataflow {
namespace {

/// A regular octahedron of volume 4/3 in eight tetrahedra around its centre; with the square z = 0 as a dangling
/// surface or without.
struct Octahedron {
  RegionBoundary boundary;
  RegionMesh mesh;

  explicit Octahedron(bool has_dangling_square) {
    boundary.coordinates = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}, {0, 0, 0}};
    if (!has_dangling_square) boundary.coordinates.pop_back();
    std::vector<Tet> tets;
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t next = (i + 1) % 4;
      boundary.facets.push_back({i, next, 4});
      boundary.facets.push_back({next, i, 5});
      tets.push_back({6, i, next, 4});
      tets.push_back({6, next, i, 5});
    }
    boundary.sides.assign(8, 1);
    if (has_dangling_square)
      for (std::uint32_t i = 0; i < 4; ++i) {
        boundary.facets.push_back({i, (i + 1) % 4, 6});
        boundary.sides.push_back(3);
      }
    for (std::uint32_t p = 0; p < boundary.coordinates.size(); ++p) boundary.points.push_back(p);
    boundary.triangles.resize(boundary.facets.size());
    std::vector<Vec3> points = boundary.coordinates;
    points.resize(7);
    auto verdict = verified_region_mesh(boundary, points, tets, 4.0 / 3);
    EXPECT_TRUE(std::holds_alternative<RegionMesh>(verdict));
    if (auto* good = std::get_if<RegionMesh>(&verdict)) mesh = *good;
  }
  std::vector<Vec3> points() const {
    std::vector<Vec3> all = boundary.coordinates;
    all.insert(all.end(), mesh.interior_points.begin(), mesh.interior_points.end());
    return all;
  }
  double largest_volume() const {
    const std::vector<Vec3> p = points();
    double largest = 0;
    for (const Tet& t : mesh.tets)
      largest = std::max(largest, dot(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]), p[t[3]] - p[t[0]]) / 6);
    return largest;
  }
};

TEST(RefineInterior, reaches_every_volume_and_keeps_a_valid_mesh) {
  for (const bool has_dangling_square : {false, true})
    for (const double max_volume : {0.1, 0.01, 0.001}) {
      Octahedron octahedron(has_dangling_square);
      refine_interior(octahedron.boundary, octahedron.mesh, {max_volume, {}});
      EXPECT_LE(octahedron.largest_volume(), max_volume);
      const auto verdict =
          verified_region_mesh(octahedron.boundary, octahedron.points(), octahedron.mesh.tets, 4.0 / 3);
      EXPECT_TRUE(std::holds_alternative<RegionMesh>(verdict)) << std::get<Rejection>(verdict).reason;
      EXPECT_EQ(std::get<RegionMesh>(verdict).facet_tets, octahedron.mesh.facet_tets);
    }
}

TEST(RefineInterior, stops_with_a_valid_mesh_when_it_is_cancelled) {
  Octahedron octahedron(true);
  CancellationToken cancellation;
  cancellation.cancel();
  refine_interior(octahedron.boundary, octahedron.mesh, {1e-9, {}}, &cancellation);
  EXPECT_EQ(octahedron.mesh.tets.size(), 8u);
  const auto verdict = verified_region_mesh(octahedron.boundary, octahedron.points(), octahedron.mesh.tets, 4.0 / 3);
  EXPECT_TRUE(std::holds_alternative<RegionMesh>(verdict));
}

TEST(RefineInterior, comes_to_an_end_for_the_strictest_ratio) {
  Octahedron octahedron(true);
  refine_interior(octahedron.boundary, octahedron.mesh, {0.005, 1.1});
  EXPECT_LE(octahedron.largest_volume(), 0.005);
  EXPECT_LT(octahedron.mesh.tets.size(), 20000u);
}

TEST(RefineInterior, does_nothing_without_a_goal_or_when_it_is_met) {
  Octahedron octahedron(false);
  const std::vector<Tet> before = octahedron.mesh.tets;
  refine_interior(octahedron.boundary, octahedron.mesh, {});
  refine_interior(octahedron.boundary, octahedron.mesh, {1.0, 10.0});
  EXPECT_EQ(octahedron.mesh.tets, before);
}

TEST(TetFaces, every_face_knows_its_partner_or_the_side_of_its_facet) {
  const Octahedron octahedron(true);
  const std::vector<std::uint32_t> behind =
      tet_neighbours(octahedron.boundary.facets, octahedron.points().size(), octahedron.mesh.tets);
  for (std::uint32_t face = 0; face < behind.size(); ++face) {
    if (is_facet_code(behind[face]))
      EXPECT_EQ(octahedron.mesh.facet_tets[facet_of_code(behind[face])][side_of_code(behind[face])], face / 4);
    else
      EXPECT_EQ(behind[behind[face]], face);
  }
}

TEST(InsertInteriorPoints, sets_what_lies_inside_and_keeps_a_valid_mesh) {
  for (const bool has_dangling_square : {false, true}) {
    Octahedron octahedron(has_dangling_square);
    const std::size_t before = octahedron.mesh.interior_points.size();
    const std::vector<Vec3> points{{0.2, 0.1, 0.3}, {2, 0, 0}, {-0.1, 0.2, -0.4}, {-0.25, -0.2, 0.2}};
    EXPECT_EQ(insert_interior_points(octahedron.boundary, octahedron.mesh, points),
              (std::vector<std::uint32_t>{0, 2, 3}));
    ASSERT_EQ(octahedron.mesh.interior_points.size(), before + 3);
    EXPECT_EQ(octahedron.mesh.interior_points[before + 1], points[2]);
    auto verdict = verified_region_mesh(octahedron.boundary, octahedron.points(), octahedron.mesh.tets, 4.0 / 3);
    EXPECT_TRUE(std::holds_alternative<RegionMesh>(verdict));
  }
}

TEST(InsertInteriorPoints, leaves_empty_spheres_where_they_were_empty) {
  Octahedron octahedron(false);  // its corners and middle are Delaunay
  std::vector<Vec3> points;
  for (int i = 0; i < 40; ++i)
    points.push_back({0.45 * std::sin(2.1 * i), 0.45 * std::cos(3.7 * i), 0.08 * std::sin(i)});
  ASSERT_EQ(insert_interior_points(octahedron.boundary, octahedron.mesh, points).size(), 40u);
  const std::vector<Vec3> p = octahedron.points();
  for (const Tet& t : octahedron.mesh.tets) {
    const Vec3 u = p[t[1]] - p[t[0]], v = p[t[2]] - p[t[0]], w = p[t[3]] - p[t[0]];
    const Vec3 centre = p[t[0]] + (0.5 / dot(cross(u, v), w)) *
                                      (dot(w, w) * cross(u, v) + dot(v, v) * cross(w, u) + dot(u, u) * cross(v, w));
    for (const Vec3& other : p) EXPECT_GE(length(other - centre), (1 - 1e-9) * length(p[t[0]] - centre));
  }
}

}  // namespace
}  // namespace strataflow
