#include "kernels/contacts/guide_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/contacts/raw_surfaces.h"

namespace strataflow {
namespace {

using support::add_grid;
using support::add_patch;
using support::add_triangle;

std::uint32_t vertex_at(const ContactMesh& mesh, const Vec3& p) {
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v)
    if (mesh.point(v) == p) return v;
  return no_index;
}

TEST(GuidePath, follows_the_plane_where_a_graph_would_cut_across) {
  // Ten columns of triangles along the plane z = 0; above them a fan whose apex makes a way of fewer triangles.
  TriangleSoup soup;
  const std::uint32_t patch = add_patch(soup, "F1");
  const auto x = [](double y) { return 0.2 * y * y; };
  add_grid(soup, patch, 20, 1, [&](double u, double v) { return Vec3{x(10 * u - 5), 10 * u - 5, 1.7 * v - 1}; });
  for (int i = 0; i < 20; ++i)
    add_triangle(soup, patch, {x(0.5 * i - 5), 0.5 * i - 5, 0.7}, {x(0.5 * i - 4.5), 0.5 * i - 4.5, 0.7}, {0, 0, 3});
  ContactMesh mesh(soup);
  const Vec3 from{x(-5), -5, 0}, to{x(5), 5, 0};
  const std::uint32_t u = mesh.add_vertex(from), v = mesh.add_vertex(to);
  mesh.split_edge(vertex_at(mesh, {x(-5), -5, -1}), vertex_at(mesh, {x(-5), -5, 0.7}), u);
  mesh.split_edge(vertex_at(mesh, {x(5), 5, -1}), vertex_at(mesh, {x(5), 5, 0.7}), v);
  const auto path = find_guide_path(mesh, 0, u, v, {from, to, from + Vec3{1, 0, 0}}, 100);
  ASSERT_TRUE(path);
  EXPECT_EQ(path->size(), 39u);  // 19 uprights and 20 diagonals
  double y = -5;
  for (const PathNode& node : *path) {
    EXPECT_EQ(node.point.z, 0);
    EXPECT_GT(node.point.y, y);
    y = node.point.y;
  }
  EXPECT_FALSE(find_guide_path(mesh, 0, u, v, {from, to, from + Vec3{1, 0, 0}}, 10.1));
}

TEST(GuidePath, a_vertex_within_rounding_of_the_plane_is_where_the_path_passes) {
  // The plane runs along a line of vertices that rounding has put on either side of it.
  const Vec3 along{std::cos(0.7), std::sin(0.7) * std::cos(0.4), std::sin(0.7) * std::sin(0.4)};
  const Vec3 across{-std::sin(0.7), std::cos(0.7) * std::cos(0.4), std::cos(0.7) * std::sin(0.4)};
  for (int n = 2; n < 40; ++n) {
    TriangleSoup soup;
    add_grid(soup, add_patch(soup, "F1"), static_cast<std::uint32_t>(n), 2, [&](double u, double v) {
      return Vec3{300, 200, 100} + (577.1 * u) * along + (100 * v - 50) * across;
    });
    const ContactMesh mesh(soup);
    const std::uint32_t u = static_cast<std::uint32_t>(n) + 1, v = 2 * u - 1;  // the ends of the middle row
    const Vec3 from = mesh.point(u), to = mesh.point(v);
    const auto path = find_guide_path(mesh, 0, u, v, {from, to, from + 577.1 * cross(along, across)}, 600);
    ASSERT_TRUE(path) << n;
    for (const PathNode& node : *path) EXPECT_NEAR(dot(node.point - from, across), 0, 1e-9) << n;
  }
}

TEST(GuidePath, goes_the_short_way_round_a_closed_surface) {
  TriangleSoup soup;
  add_grid(soup, add_patch(soup, "Salt", Role::intrusion), 24, 2, [](double u, double v) {
    const int i = static_cast<int>(std::lround(24 * u)) % 24;
    return Vec3{std::cos(i * M_PI / 12), std::sin(i * M_PI / 12), 2 * v};
  });
  const ContactMesh mesh(soup);
  const Vec3 from{1, 0, 1}, to{std::cos(7 * M_PI / 12), std::sin(7 * M_PI / 12), 1};
  const std::uint32_t u = vertex_at(mesh, from), v = vertex_at(mesh, to);
  const auto path = find_guide_path(mesh, 0, u, v, {from, to, {0, 0, 1}}, 100);
  ASSERT_TRUE(path);
  EXPECT_EQ(path->size(), 6u);
  for (const PathNode& node : *path) EXPECT_TRUE(node.is_vertex());
}

TEST(GuidePath, crosses_into_faces_that_earlier_cuts_have_separated_but_not_into_other_surfaces) {
  TriangleSoup soup;
  const std::uint32_t left = add_patch(soup, "F1");
  add_grid(soup, left, 2, 2, [](double u, double v) { return Vec3{0, u, v}; });
  add_grid(soup, support::add_patch_of(soup, 0), 2, 2, [](double u, double v) { return Vec3{0, 1 + u, v}; });
  ContactMesh mesh(soup);
  const std::uint32_t u = vertex_at(mesh, {0, 0, 0.5}), v = vertex_at(mesh, {0, 2, 0.5});
  EXPECT_TRUE(find_guide_path(mesh, 0, u, v, {{0, 0, 0.5}, {0, 2, 0.5}, {1, 0, 0.5}}, 10));
  soup.entities.push_back({"F2", Role::fault});
  soup.patch_entity[1] = 1;
  const ContactMesh apart(soup);
  EXPECT_FALSE(find_guide_path(apart, 0, u, v, {{0, 0, 0.5}, {0, 2, 0.5}, {1, 0, 0.5}}, 10));
}

}  // namespace
}  // namespace strataflow
