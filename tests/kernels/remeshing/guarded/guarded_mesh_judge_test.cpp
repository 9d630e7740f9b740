// The refusals of GuardedMesh.
#include "kernels/remeshing/guarded/guarded_mesh.h"
#include "kernels/remeshing/guarded/mesh_of_soup.h"

namespace strataflow {
namespace {

using Mesh = support::MeshOfSoup;

TEST(GuardedMeshJudge, refuses_what_would_meet_another_surface) {
  // A pyramid over a blade that reaches up into it.
  TriangleSoup soup;
  const auto roof = support::add_patch(soup, "roof"), blade = support::add_patch(soup, "blade");
  const Vec3 top{0, 0, 0.6}, a{1, 1, 0}, b{-1, 1, 0}, c{-1, -1, 0}, d{1, -1, 0};
  const auto out = [](const Vec3& p) { return Vec3{3 * p.x, 3 * p.y, 0}; };
  for (const auto& [x, y] : {std::pair{a, b}, {b, c}, {c, d}, {d, a}}) {
    support::add_triangle(soup, roof, top, x, y);
    support::add_quad(soup, roof, x, out(x), out(y), y);
  }
  support::add_triangle(soup, blade, {0.1, 0.2, -2}, {0.2, 0.1, -2}, {0.1, 0.1, 0.3});
  Mesh m(soup, 10, 89);
  EXPECT_EQ(m.mesh.collapse_edge(m.at(top), m.at(a), {}), Verdict::crossing);
  m.expect_valid();
}

TEST(GuardedMeshJudge, refuses_to_jump_over_a_small_piece_that_touches_nothing) {
  TriangleSoup soup;
  const auto roof = support::add_patch(soup, "roof"), speck = support::add_patch(soup, "speck");
  const Vec3 top{0, 0, 0.6}, a{1, 1, 0}, b{-1, 1, 0}, c{-1, -1, 0}, d{1, -1, 0};
  const auto out = [](const Vec3& p) { return Vec3{3 * p.x, 3 * p.y, 0}; };
  for (const auto& [x, y] : {std::pair{a, b}, {b, c}, {c, d}, {d, a}}) {
    support::add_triangle(soup, roof, top, x, y);
    support::add_quad(soup, roof, x, out(x), out(y), y);
  }
  support::add_triangle(soup, speck, {0.1, 0.2, 0.2}, {0.2, 0.1, 0.2}, {0.1, 0.1, 0.3});
  Mesh m(soup, 10, 89);
  EXPECT_EQ(m.mesh.collapse_edge(m.at(top), m.at(a), {}), Verdict::crossing);
}

TEST(GuardedMeshJudge, refuses_to_leave_the_input_behind) {
  TriangleSoup soup;
  support::add_grid(soup, "bump", 8, [](double u, double v) {
    return Vec3{8 * u, 8 * v, u == 0.5 && v == 0.5 ? 0.5 : 0};
  });
  Mesh strict(soup, 0.2, 89), loose(soup, 0.6, 89);
  EXPECT_EQ(strict.mesh.collapse_edge(strict.at({4, 4, 0.5}), strict.at({5, 4, 0}), {}), Verdict::strayed);
  EXPECT_EQ(loose.mesh.collapse_edge(loose.at({4, 4, 0.5}), loose.at({5, 4, 0}), {}), Verdict::done);
}

TEST(GuardedMeshJudge, refuses_to_cut_off_a_bend_of_a_line) {
  TriangleSoup soup;
  support::add_grid(soup, "sheet", 8, [](double u, double v) {
    return Vec3{8 * u, v == 0 ? std::sin(8 * u) : 4 + 4 * v, 0};
  });
  Mesh strict(soup, 0.05, 89), loose(soup, 1.0, 89);
  const Vec3 from{2, std::sin(2.0), 0}, to{1, std::sin(1.0), 0};
  EXPECT_EQ(strict.mesh.collapse_edge(strict.at(from), strict.at(to), {}), Verdict::strayed);
  EXPECT_EQ(loose.mesh.collapse_edge(loose.at(from), loose.at(to), {}), Verdict::done);
}

TEST(GuardedMeshJudge, refuses_to_turn_triangles_over) {
  Mesh m(support::standing_sheet());
  const std::uint32_t v = m.at({2, 2, 0});
  EXPECT_EQ(m.mesh.move_vertex(v, {4.5, 2.2, 0}, {}), Verdict::turned);
  EXPECT_EQ(m.mesh.point(v), (Vec3{2, 2, 0}));
  EXPECT_EQ(m.mesh.move_vertex(v, {2.3, 2.2, 5}, {}), Verdict::done);
  EXPECT_EQ(m.mesh.point(v), (Vec3{2.3, 2.2, 0})) << "on the sheet to the last bit";
  m.expect_valid();
}

TEST(GuardedMeshJudge, refuses_to_change_the_order_of_surfaces_around_a_contact) {
  // Sliding the tip of the first sheet along its border would lead it past the second, low one without touching it.
  TriangleSoup soup;
  const Vec3 a{0, 0, 0}, b{1, 0, 0};
  const auto place = [](double x, double radius, double angle_deg) {
    const double angle = angle_deg * 0.017453292519943295;
    return Vec3{x, radius * std::cos(angle), radius * std::sin(angle)};
  };
  const Vec3 tip = place(0.5, 1, 0), next = place(0.3, 1, 40);
  const auto first = support::add_patch(soup, "first"), second = support::add_patch(soup, "second"),
             third = support::add_patch(soup, "third");
  support::add_triangle(soup, first, a, b, tip);
  support::add_triangle(soup, first, a, tip, next);
  support::add_triangle(soup, second, a, b, place(0.9, 0.1, 20));
  support::add_triangle(soup, third, a, b, {0.5, -1, 0});
  Mesh m(soup, 10, 89);
  const std::uint32_t v = m.at(tip);
  ASSERT_EQ(m.mesh.kind(v), VertexKind::line);
  const auto [from, here, to] = m.mesh.arcs_around(v);
  const bool is_next_after = length(m.mesh.point(m.mesh.line_neighbours(v)[1]) - next) < 1e-9;
  const double toward = is_next_after ? to : from;
  EXPECT_EQ(m.mesh.slide_vertex(v, here + 0.2 * (toward - here), {}), Verdict::done);
  const double now = m.mesh.arcs_around(v)[1];
  EXPECT_EQ(m.mesh.slide_vertex(v, now + 0.9 * (toward - now), {}), Verdict::reordered);
  m.expect_valid();
}

TEST(GuardedMeshJudge, makes_no_triangle_of_three_vertices_in_a_row_on_one_line) {
  Mesh m(support::standing_sheet());
  // (2,5) goes onto the contact: (2,4), (3,4) and … would be joined beside it.
  EXPECT_EQ(m.mesh.collapse_edge(m.at({2, 5, 0}), m.at({1, 4, 0}), {}), Verdict::done);
  EXPECT_NE(m.mesh.flip_edge(m.at({2, 4, 0}), m.at({3, 5, 0}), {}), Verdict::done);
  m.expect_valid();
}

}  // namespace
}  // namespace strataflow
