#include "kernels/remeshing/guarded/guarded_mesh.h"

#include <algorithm>
#include <array>

#include "kernels/remeshing/guarded/mesh_of_soup.h"

namespace strataflow {
namespace {

using Mesh = support::MeshOfSoup;

TEST(GuardedMesh, starts_as_a_copy_of_its_model) {
  const Mesh m(support::layered_box(4));
  EXPECT_EQ(m.alive(), m.model.triangles.size());
  m.expect_valid();
}

TEST(GuardedMesh, collapses_along_a_contact_in_all_its_surfaces_at_once) {
  Mesh m(support::standing_sheet());
  const std::size_t before = m.alive();
  EXPECT_EQ(m.mesh.collapse_edge(m.at({3, 4, 0}), m.at({4, 4, 0}), {}), Verdict::done);
  EXPECT_EQ(m.alive(), before - 3);  // three surfaces
  EXPECT_NE(m.mesh.line_of_edge(m.at({2, 4, 0}), m.at({4, 4, 0})), no_index);
  m.expect_valid();
}

TEST(GuardedMesh, never_takes_a_corner_or_a_line_vertex_off_its_line) {
  Mesh m(support::standing_sheet());
  EXPECT_EQ(m.mesh.collapse_edge(m.at({0, 4, 0}), m.at({1, 4, 0}), {}), Verdict::fixed);  // the contact's end
  EXPECT_EQ(m.mesh.collapse_edge(m.at({3, 4, 0}), m.at({3, 5, 0}), {}), Verdict::fixed);  // into a surface
  EXPECT_EQ(m.mesh.collapse_edge(m.at({1, 4, 0}), m.at({0, 4, 0}), {}), Verdict::done);   // into the corner
  EXPECT_EQ(m.mesh.collapse_edge(m.at({3, 5, 0}), m.at({3, 4, 0}), {}), Verdict::done);   // from a surface
  m.expect_valid();
}

TEST(GuardedMesh, keeps_three_edges_of_a_closed_line) {
  TriangleSoup soup;
  const auto patch = support::add_patch(soup, "disc");
  const auto rim = [](int k) { return Vec3{std::cos(k * 1.0471975511965976), std::sin(k * 1.0471975511965976), 0}; };
  for (int k = 0; k < 6; ++k) support::add_triangle(soup, patch, {0, 0, 0}, rim(k), rim((k + 1) % 6));
  Mesh m(soup, 10, 89);
  for (const int k : {0, 2, 4}) EXPECT_EQ(m.mesh.collapse_edge(m.at(rim(k + 1)), m.at(rim(k)), {}), Verdict::done);
  EXPECT_EQ(m.mesh.collapse_edge(m.at(rim(2)), m.at(rim(0)), {}), Verdict::fixed);
  m.expect_valid();
  TriangleSoup triangle;
  const auto own = support::add_patch(triangle, "triangle");
  support::add_triangle(triangle, own, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  Mesh one(triangle, 10, 89);
  EXPECT_EQ(one.mesh.collapse_edge(0, 1, {}), Verdict::fixed);
}

TEST(GuardedMesh, refuses_a_collapse_that_would_pinch_the_surface) {
  // w inside triangle a b c inside a larger one: a and b have c in common, but no triangle of theirs has.
  TriangleSoup soup;
  const auto patch = support::add_patch(soup, "nested");
  const Vec3 A{0, 9, 0}, B{-9, -6, 0}, C{9, -6, 0}, a{0, 3, 0}, b{-3, -2, 0}, c{3, -2, 0}, w{0, 0, 0};
  for (const auto& [x, y, z] :
       {std::array{a, b, w}, {b, c, w}, {c, a, w}, {A, B, a}, {B, b, a}, {B, C, b}, {C, c, b}, {C, A, c}, {A, a, c}})
    support::add_triangle(soup, patch, x, y, z);
  Mesh m(soup, 10, 89);
  EXPECT_EQ(m.mesh.collapse_edge(m.at(a), m.at(b), {}), Verdict::topology);
  EXPECT_EQ(m.mesh.collapse_edge(m.at(w), m.at(b), {}), Verdict::done);
  m.expect_valid();
}

TEST(GuardedMesh, splits_and_flips_only_where_that_keeps_lines) {
  Mesh m(support::standing_sheet());
  const std::uint32_t a = m.at({3, 4, 0}), b = m.at({4, 4, 0});
  EXPECT_EQ(m.mesh.flip_edge(a, b, {}), Verdict::fixed);
  EXPECT_EQ(m.mesh.split_edge(a, b, {}), Verdict::done);
  const std::uint32_t middle = m.mesh.vertex_count() - 1;
  EXPECT_EQ(m.mesh.point(middle), (Vec3{3.5, 4, 0}));
  EXPECT_EQ(m.mesh.kind(middle), VertexKind::line);
  EXPECT_EQ(m.mesh.split_edge(a, b, {}), Verdict::topology) << "there is no such edge any more";
  EXPECT_EQ(m.mesh.flip_edge(m.at({2, 2, 0}), m.at({3, 3, 0}), {}), Verdict::done);
  EXPECT_EQ(m.mesh.flip_edge(m.at({2, 2, 0}), m.at({3, 3, 0}), {}), Verdict::topology);
  m.expect_valid();
}

TEST(GuardedMesh, counts_how_its_steps_ended) {
  Mesh m(support::standing_sheet());
  EXPECT_EQ(m.mesh.move_vertex(m.at({0, 0, 0}), {1, 1, 0}, {}), Verdict::fixed);
  EXPECT_EQ(m.mesh.verdicts()[static_cast<std::size_t>(Verdict::fixed)], 1u);
  EXPECT_EQ(m.mesh.step_count(), 0u);
  EXPECT_EQ(m.mesh.move_vertex(m.at({2, 2, 0}), {2.1, 2, 0}, {}), Verdict::done);
  EXPECT_EQ(m.mesh.step_count(), 1u);
  EXPECT_EQ(m.mesh.star_changed_at(m.at({3, 2, 0})), 1u);
  EXPECT_EQ(m.mesh.star_changed_at(m.at({6, 6, 0})), 0u);
}

TEST(GuardedMesh, goes_on_as_before_once_it_is_numbered_anew) {
  Mesh plain(support::layered_box(4)), anew(support::layered_box(4));
  const auto change = [](Mesh& m) {
    EXPECT_EQ(m.mesh.split_edge(m.at({0, 0, 0}), m.at({2.5, 0, 0}), {}), Verdict::done);
    EXPECT_EQ(m.mesh.collapse_edge(m.at({5, 5, 0}), m.at({7.5, 5, 0}), {}), Verdict::done);
  };
  change(plain);
  change(anew);
  anew.mesh.renumber();
  EXPECT_EQ(anew.alive(), anew.mesh.triangle_count()) << "the dead keep no numbers";
  EXPECT_EQ(anew.mesh.step_count(), plain.mesh.step_count());
  anew.expect_valid();
  for (Mesh* m : {&plain, &anew}) {
    EXPECT_EQ(m->mesh.slide_vertex(m->at({1.25, 0, 0}), m->mesh.arcs_around(m->at({1.25, 0, 0}))[1] + 0.25, {}),
              Verdict::done);
    // Straight through the box: the guard still finds what is in the way.
    EXPECT_EQ(m->mesh.move_vertex(m->at({2.5, 2.5, 0}), {2.5, 2.75, 0}, {}), Verdict::done);
    EXPECT_EQ(m->mesh.collapse_edge(m->at({2.5, 2.75, 0}), m->at({0, 2.5, 0}), {}), Verdict::done);
    m->expect_valid();
  }
  const auto sorted_points = [](const Mesh& m) {
    std::vector<std::array<double, 3>> points;
    for (const Vec3& p : m.mesh.soup().points) points.push_back({p[0], p[1], p[2]});
    std::sort(points.begin(), points.end());
    return points;
  };
  EXPECT_EQ(sorted_points(plain), sorted_points(anew));
}

}  // namespace
}  // namespace strataflow
