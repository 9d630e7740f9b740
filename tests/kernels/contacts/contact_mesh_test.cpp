#include "kernels/contacts/contact_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/seed.h"
#include "kernels/contacts/raw_surfaces.h"

namespace strataflow {
namespace {

using support::add_patch;
using support::area_m2;

TEST(ContactMesh, splits_an_edge_in_every_surface_around_it) {
  TriangleSoup soup;
  support::add_quad(soup, add_patch(soup, "F1"), {0, 0, 0}, {0, 2, 0}, {0, 2, 2}, {0, 0, 2});
  support::add_quad(soup, add_patch(soup, "H1"), {0, 0, 0}, {0, 2, 2}, {2, 2, 2}, {2, 0, 0});  // along F1's diagonal
  ContactMesh mesh(soup);
  const std::uint32_t a = mesh.vertex_of_input(0), b = mesh.vertex_of_input(2);
  EXPECT_EQ(mesh.triangles_at(a, b).size(), 3u);
  EXPECT_FALSE(mesh.is_soft(a, b));
  const std::uint32_t middle = mesh.add_vertex({0, 1, 1});
  mesh.split_edge(a, b, middle);
  EXPECT_EQ(mesh.count_at(a, middle, 0), 2u);
  EXPECT_EQ(mesh.count_at(middle, b, 1), 1u);
  EXPECT_TRUE(mesh.triangles_at(a, b).empty());
  const TriangleSoup out = mesh.soup_like(soup);
  EXPECT_EQ(out.triangles.size(), 7u);
  EXPECT_DOUBLE_EQ(area_m2(out, 0), 4);
  EXPECT_DOUBLE_EQ(area_m2(out, 1), area_m2(soup, 1));
}

TEST(ContactMesh, segments_inside_a_triangle_are_inserted_by_flips_and_add_no_points) {
  // Random points in one large triangle, then every pair of neighbours in a random order joined where nothing is in
  // the way: area and orientation stay, and so does the number of points.
  TriangleSoup soup;
  support::add_triangle(soup, add_patch(soup, "F1"), {0, 0, 0}, {10, 0, 3}, {0, 10, 1});
  ContactMesh mesh(soup);
  RandomStream random(11);
  std::vector<std::uint32_t> inside;
  for (int i = 0; i < 60; ++i) {
    const double u = 0.05 + 0.4 * random.unit(), v = 0.05 + 0.4 * random.unit();
    const Vec3 p = u * Vec3{10, 0, 3} + v * Vec3{0, 10, 1};
    for (std::uint32_t t : std::vector<std::uint32_t>(mesh.triangles_of(0))) {
      const Triangle& tri = mesh.triangle(t);
      bool is_in = true;
      for (int k = 0; k < 3; ++k) {
        const Vec3 &a = mesh.point(tri[k]), &b = mesh.point(tri[(k + 1) % 3]);
        is_in &= (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0;
      }
      if (!is_in) continue;
      inside.push_back(mesh.add_vertex(p));
      mesh.split_triangle(t, inside.back());
      break;
    }
  }
  ASSERT_EQ(inside.size(), 60u);
  mesh.widen_angles();
  int inserted = 0;
  for (std::size_t i = 0; i + 1 < inside.size(); ++i) {
    std::vector<std::uint32_t> passed;
    if (mesh.insert_segment(inside[i], inside[i + 1], 0, passed)) {
      ++inserted;
      EXPECT_TRUE(mesh.has_edge(inside[i], inside[i + 1], 0));
    }
  }
  EXPECT_EQ(inserted, 59);
  const TriangleSoup out = mesh.soup_like(soup);
  EXPECT_EQ(out.points.size(), 63u);
  EXPECT_EQ(out.triangles.size(), 121u);
  EXPECT_NEAR(area_m2(out, 0), area_m2(soup, 0), 1e-10);
  const Vec3 up = cross(Vec3{10, 0, 3}, Vec3{0, 10, 1});
  for (const Triangle& t : out.triangles)
    EXPECT_GT(dot(cross(out.points[t[1]] - out.points[t[0]], out.points[t[2]] - out.points[t[0]]), up), 0);
}

TEST(ContactMesh, flips_widen_angles_inside_a_plane_and_never_cross_its_edges) {
  TriangleSoup soup;
  support::add_quad(soup, add_patch(soup, "F1"), {0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0});
  ContactMesh mesh(soup);
  const std::uint32_t a = mesh.vertex_of_input(0), c = mesh.vertex_of_input(2);
  for (int i = 1; i < 10; ++i) {
    const std::uint32_t vertex = mesh.add_vertex({i * 1.0, i * 0.5, 0});
    for (const std::uint32_t t : std::vector<std::uint32_t>(mesh.triangles_of(0))) {
      const Triangle& tri = mesh.triangle(t);
      bool is_in = true;
      for (int k = 0; k < 3; ++k)
        is_in &= dot(cross(mesh.point(tri[(k + 1) % 3]) - mesh.point(tri[k]), mesh.point(vertex) - mesh.point(tri[k])),
                     {0, 0, 1}) > 0;
      if (is_in) {
        mesh.split_triangle(t, vertex);
        break;
      }
    }
  }
  mesh.widen_angles();
  EXPECT_TRUE(mesh.has_edge(a, c, 0));  // the diagonal parts two planes and stays
  EXPECT_NEAR(area_m2(mesh.soup_like(soup), 0), 100, 1e-12);
}

TEST(ContactMesh, a_merged_vertex_takes_its_triangles_along_and_collapsed_ones_vanish) {
  TriangleSoup soup;
  support::add_grid(soup, add_patch(soup, "H1"), 2, 2, [](double u, double v) { return Vec3{2 * u, 2 * v, 0}; });
  ContactMesh mesh(soup);
  mesh.merge(mesh.vertex_of_input(1), mesh.vertex_of_input(0), 1e-9);
  EXPECT_EQ(mesh.vertex_of_input(1), mesh.vertex_of_input(0));
  EXPECT_EQ(mesh.soup_like(soup).triangles.size(), 7u);
  EXPECT_EQ(mesh.soup_like(soup).points.size(), 8u);
  EXPECT_GT(mesh.moves_of(0), 0u);
}

TEST(ContactMesh, degenerate_triangles_are_left_out_and_the_rest_comes_back_as_it_was) {
  TriangleSoup soup = support::raw_box(0.1, 2);
  const std::size_t count = soup.triangles.size();
  soup.triangles.push_back({0, 0, 1});
  soup.triangle_patch.push_back(0);
  const TriangleSoup out = ContactMesh(soup).soup_like(soup);
  EXPECT_EQ(out.triangles.size(), count);
  for (std::size_t t = 0; t < count; ++t)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(out.points[out.triangles[t][k]], soup.points[soup.triangles[t][k]]);
}

}  // namespace
}  // namespace strataflow
