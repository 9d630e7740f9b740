#include "kernels/borders/simplify_borders.h"

#include <gtest/gtest.h>

#include "base/archive.h"
#include "base/digest.h"
#include "kernels/borders/strips.h"
#include "kernels/intersection/find_intersections.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/topology/building/build_structural_model.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

Digest digest(const TriangleSoup& soup) {
  ArchiveWriter bytes;
  bytes(soup);
  return digest_of(bytes.bytes());
}

TEST(SimplifyBorders, gives_all_sides_of_a_contact_the_same_few_nodes) {  // euler1999 §4.2 test 6
  const TriangleSoup soup = support::three_strips();
  const Result<SimplifiedSoup> once = simplify_borders(soup, {1, 45});
  ASSERT_TRUE(once);
  EXPECT_TRUE(once->report.refused.empty());
  EXPECT_EQ(support::axis_nodes(soup, 0).size(), 29u);
  const std::set<double> nodes = support::axis_nodes(once->soup, 0);
  EXPECT_EQ(nodes.size(), 11u) << "ten edges: as many as the coarsest strip has";
  EXPECT_EQ(support::axis_nodes(once->soup, 1), nodes);
  EXPECT_EQ(support::axis_nodes(once->soup, 2), nodes);
  EXPECT_GT(once->report.relaxed_nodes, 20u);
  EXPECT_GT(support::smallest_angle_deg(once->soup), 2 * support::smallest_angle_deg(soup));
  EXPECT_TRUE(find_intersections(once->soup.points, once->soup.triangles).empty());
}

TEST(SimplifyBorders, changes_nothing_once_it_has_converged) {
  const Result<SimplifiedSoup> done = simplify_borders(support::three_strips(), {10, 45});
  ASSERT_TRUE(done);
  EXPECT_LE(done->report.passes, 3u);
  const Result<SimplifiedSoup> again = simplify_borders(done->soup, {10, 45});
  ASSERT_TRUE(again);
  EXPECT_EQ(again->report.passes, 0u);
  EXPECT_EQ(digest(again->soup), digest(done->soup));
}

TEST(SimplifyBorders, gives_the_same_bits_on_every_schedule) {
  const Digest expected = digest(simplify_borders(support::three_strips())->soup);
  support::on_every_schedule([&](const char* schedule) {
    EXPECT_EQ(digest(simplify_borders(support::three_strips())->soup), expected) << schedule;
  });
}

/// A box of two layers whose walls are strips of quads, the horizon's border refined: `more` nodes on every wall.
TriangleSoup refined_box(int cells, int more) {
  TriangleSoup soup;
  const std::uint32_t walls = support::add_patch(soup, "box", Role::boundary);
  const auto corner = [&](int side) { return Vec3{side == 1 || side == 2 ? 8.0 : 0.0, side >= 2 ? 8.0 : 0.0, 0}; };
  const std::uint32_t horizon = support::add_patch(soup, "H", Role::horizon);
  std::vector<Vec3> rim, caps;
  for (int side = 0; side < 4; ++side) {
    const Vec3 from = corner(side), to = corner((side + 1) % 4);
    for (int i = 0; i < cells; ++i) {
      const Vec3 a = from + (1.0 * i / cells) * (to - from), b = from + (1.0 * (i + 1) / cells) * (to - from);
      const Vec3 up{0, 0, 4}, down{0, 0, -4};
      Vec3 last = a;
      for (int k = 1; k <= more + 1; ++k) {
        const Vec3 next = k == more + 1 ? b : a + (1.0 * k / (more + 1)) * (b - a);
        support::add_triangle(soup, walls, last, next, b + up);
        support::add_triangle(soup, walls, next, last, a + down);
        rim.push_back(last);
        last = next;
      }
      support::add_triangle(soup, walls, a, b + up, a + up);
      support::add_triangle(soup, walls, b, a + down, b + down);
      caps.push_back(a);
    }
  }
  const auto add_cap = [&](std::uint32_t patch, const std::vector<Vec3>& around, double z) {
    for (std::size_t i = 0; i < around.size(); ++i)
      support::add_triangle(soup, patch, {4, 4, z}, around[i] + Vec3{0, 0, z},
                            around[(i + 1) % around.size()] + Vec3{0, 0, z});
  };
  add_cap(horizon, rim, 0);
  add_cap(walls, caps, 4);
  add_cap(walls, caps, -4);
  return soup;
}

TEST(SimplifyBorders, keeps_regions_volumes_and_the_corners_of_the_box) {
  const TriangleSoup soup = refined_box(8, 2);
  const Result<SimplifiedSoup> simplified = simplify_borders(soup);
  ASSERT_TRUE(simplified);
  EXPECT_TRUE(simplified->report.refused.empty());
  EXPECT_EQ(simplified->report.border_count, 4u);
  EXPECT_LT(simplified->report.nodes_after, simplified->report.nodes_before / 2);
  const Result<BuiltModel> before = build_structural_model(soup), after = build_structural_model(simplified->soup);
  ASSERT_TRUE(before && after);
  EXPECT_TRUE(before->model.is_sealed && after->model.is_sealed);
  ASSERT_EQ(after->model.regions.size(), before->model.regions.size());
  for (std::size_t r = 0; r < before->model.regions.size(); ++r)
    EXPECT_NEAR(after->model.regions[r].volume_m3, before->model.regions[r].volume_m3, 1e-9);
  EXPECT_EQ(after->model.lines.size(), before->model.lines.size());
  for (const Vec3 corner : {Vec3{0, 0, 0}, Vec3{8, 0, 0}, Vec3{8, 8, 0}, Vec3{0, 8, 0}})
    EXPECT_EQ(std::count(simplified->soup.points.begin(), simplified->soup.points.end(), corner), 1);
}

TEST(SimplifyBorders, refuses_a_contact_whose_coarser_form_would_cross_another_surface) {
  // An arch of many nodes over the x axis; coarser, it cuts into a needle that reaches up below its top.
  TriangleSoup soup;
  const std::uint32_t left = support::add_patch(soup, "left"), right = support::add_patch(soup, "right");
  constexpr int n = 24;
  const auto on_arch = [](int i) { return Vec3{i - n / 2.0, 0, 8 - (i - n / 2.0) * (i - n / 2.0) / 18.0}; };
  for (int i = 0; i < n; i += n / 2) {  // representative nodes: the middle only
    const Vec3 apex{on_arch(i + n / 4).x, 6, 9};
    for (int k = i; k < i + n / 2; ++k) {
      support::add_triangle(soup, left, on_arch(k), on_arch(k + 1), apex);
      support::add_triangle(soup, right, on_arch(k + 1), on_arch(k), {apex.x, -6, 9});
    }
    const Vec3 top{0, 6, 12};
    support::add_triangle(soup, left, on_arch(n / 2), i == 0 ? top : apex, i == 0 ? apex : top);
    support::add_triangle(soup, right, on_arch(n / 2), i == 0 ? Vec3{apex.x, -6, 9} : Vec3{0, -6, 12},
                          i == 0 ? Vec3{0, -6, 12} : Vec3{apex.x, -6, 9});
  }
  const Result<SimplifiedSoup> free = simplify_borders(soup);
  ASSERT_TRUE(free);
  EXPECT_EQ(free->report.resampled_borders, 1u) << "alone it can be simplified";

  const Vec3 under{on_arch(6).x, 0, on_arch(6).z - 0.05};
  support::add_triangle(soup, support::add_patch(soup, "needle"), under, {under.x - 0.2, 0.1, 0},
                        {under.x + 0.2, 0.1, 0});
  ASSERT_TRUE(find_intersections(support::weld(soup).points, support::weld(soup).triangles).empty());
  const Result<SimplifiedSoup> refused = simplify_borders(soup);
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->report.resampled_borders, 0u);
  ASSERT_EQ(refused->report.refused.size(), 1u);
  EXPECT_EQ(refused->report.refused[0].reason, BorderRefusal::crossing);
  EXPECT_EQ(refused->soup.triangles.size(), soup.triangles.size());
  EXPECT_TRUE(find_intersections(refused->soup.points, refused->soup.triangles).empty());
}

TEST(SimplifyBorders, keeps_a_face_that_would_vanish) {
  // Between two surfaces a ribbon one triangle thin, whose two long borders would be contracted onto each other's ends.
  TriangleSoup soup;
  const std::uint32_t ribbon = support::add_patch(soup, "ribbon"), floor = support::add_patch(soup, "floor");
  const std::vector<Vec3> nodes{{0, 0, 0}, {1, 0.1, 0}, {2, 0.15, 0}, {3, 0.15, 0}, {4, 0.1, 0}, {5, 0, 0}};
  for (std::size_t i = 1; i + 2 < nodes.size(); ++i)
    support::add_triangle(soup, ribbon, nodes[0], nodes[i + 1], nodes[i]);
  support::add_triangle(soup, ribbon, nodes[0], nodes[5], nodes[4]);
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
    support::add_triangle(soup, floor, nodes[i], nodes[i + 1], {2.5, 9, 0});
  const Result<SimplifiedSoup> simplified = simplify_borders(soup);
  ASSERT_TRUE(simplified);
  std::size_t left = 0;
  for (const std::uint32_t patch : simplified->soup.triangle_patch) left += patch == ribbon;
  EXPECT_GT(left, 0u);
  EXPECT_TRUE(find_intersections(simplified->soup.points, simplified->soup.triangles).empty());
}

void expect_refused(const TriangleSoup& soup, BorderRefusal reason) {
  const Result<SimplifiedSoup> simplified = simplify_borders(soup, {1, 180});
  ASSERT_TRUE(simplified);
  EXPECT_EQ(simplified->report.resampled_borders, 0u);
  ASSERT_EQ(simplified->report.refused.size(), 1u);
  EXPECT_EQ(simplified->report.refused[0].reason, reason);
  EXPECT_EQ(digest(simplified->soup), digest(support::weld(soup))) << "left as it was";
}

TEST(SimplifyBorders, refuses_a_contact_whose_surfaces_would_change_their_order) {  // euler1999 figure 4-13
  TriangleSoup soup;
  const std::uint32_t sheet = support::add_patch(soup, "sheet"), fan = support::add_patch(soup, "fan");
  const Vec3 nodes[] = {{0, 3, 0}, {1, 3, 1}, {2, 3, 0}, {3, 3, 0}};  // the contact
  for (int i = 0; i < 3; ++i) support::add_triangle(soup, fan, nodes[i], nodes[i + 1], {6, 4, 1});
  const Vec3 low[] = {{1, 2, 0}, {2, 2, -1}, {3, 2, 0}}, high[] = {{1, 4, 0}, {2, 4, 1}};
  support::add_triangle(soup, sheet, low[0], nodes[1], nodes[0]);
  support::add_triangle(soup, sheet, low[0], nodes[2], nodes[1]);
  support::add_triangle(soup, sheet, low[0], low[1], nodes[2]);
  support::add_triangle(soup, sheet, low[1], low[2], nodes[2]);
  support::add_triangle(soup, sheet, low[2], nodes[3], nodes[2]);
  support::add_triangle(soup, sheet, nodes[0], nodes[1], high[0]);
  support::add_triangle(soup, sheet, nodes[1], nodes[2], high[0]);
  support::add_triangle(soup, sheet, nodes[2], high[1], high[0]);
  support::add_triangle(soup, sheet, nodes[2], nodes[3], high[1]);
  expect_refused(soup, BorderRefusal::reordered);
}

TEST(SimplifyBorders, refuses_a_contact_whose_surfaces_would_meet_elsewhere) {
  TriangleSoup soup;
  const std::uint32_t first = support::add_patch(soup, "first"), second = support::add_patch(soup, "second");
  const Vec3 p[] = {{0, 0, -0.5},         {1.125, 0, -0.25},      {2.125, -0.25, 0.5}, {3.125, 0.75, -0.75},
                    {0.25, 0.875, 0.125}, {0.875, 0.875, -0.375}, {2, 1.125, 0},       {-0.125, 1.875, 0.75},
                    {1.125, 2.125, -0.5}, {1.75, 2.125, -0.625},  {2, 2.75, -0.125},   {1.125, 2.875, -0.625}};
  for (const auto& [a, b, c] :
       std::vector<Triangle>{{0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 6}, {6, 9, 8}, {6, 3, 9}})
    support::add_triangle(soup, first, p[a], p[b], p[c]);
  for (const auto& [a, b, c] :
       std::vector<Triangle>{{4, 5, 7}, {5, 8, 7}, {5, 6, 8}, {7, 8, 11}, {8, 9, 10}, {8, 10, 11}})
    support::add_triangle(soup, second, p[a], p[b], p[c]);
  expect_refused(soup, BorderRefusal::pinched);
}

TEST(SimplifyBorders, refuses_a_contact_that_would_swallow_a_surface) {
  // A contact that winds, and a closed body whose corners are nodes of its middle: they would all become one node.
  TriangleSoup soup;
  const std::uint32_t left = support::add_patch(soup, "left"), right = support::add_patch(soup, "right");
  constexpr int n = 14;
  const auto node = [](int i) { return Vec3{1.0 * i, 0.02 * (i - 7) * (i - 7), 0.01 * (i - 7) * (i - 7) * (i - 7)}; };
  for (int i = 0; i < n; ++i) {
    support::add_triangle(soup, left, node(i), node(i + 1), {7, 9, 0});
    support::add_triangle(soup, right, node(i + 1), node(i), {7, -9, 0});
  }
  ASSERT_EQ(simplify_borders(soup, {1, 180})->report.resampled_borders, 1u) << "alone it can be simplified";
  const std::uint32_t body = support::add_patch(soup, "body");
  const Vec3 a = node(4), b = node(6), c = node(8), d = node(10);
  support::add_triangle(soup, body, a, b, c);
  support::add_triangle(soup, body, b, a, d);
  support::add_triangle(soup, body, c, b, d);
  support::add_triangle(soup, body, a, c, d);
  expect_refused(soup, BorderRefusal::emptied);
}

TEST(SimplifyBorders, interpolates_values_at_new_nodes) {
  TriangleSoup soup = support::three_strips();
  soup.properties.push_back({"x", "m", 1, {}});
  for (const Vec3& p : soup.points) soup.properties[0].values.push_back(p.x);
  const Result<SimplifiedSoup> simplified = simplify_borders(soup);
  ASSERT_TRUE(simplified);
  ASSERT_EQ(simplified->soup.properties[0].values.size(), simplified->soup.points.size());
  for (std::size_t v = 0; v < simplified->soup.points.size(); ++v) {
    const Vec3& p = simplified->soup.points[v];
    if (p.y == 0 && p.z == 0) {
      EXPECT_NEAR(simplified->soup.properties[0].values[v], p.x, 1e-12);
    }
  }
}

/// Whole models: contacts that are pinch-outs, fans and near-parallel wedges among them.
TEST(SimplifyBorders, keeps_reference_models_sealed_with_the_same_regions) {
  for (const char* name : {"A1", "A2", "A3", "A4", "A5", "A6"}) {
    const Result<TriangleSoup> model = generate_reference_model(name);
    ASSERT_TRUE(model) << name;
    const Result<SimplifiedSoup> simplified = simplify_borders(*model);
    ASSERT_TRUE(simplified) << name;
    const SimplificationReport& report = simplified->report;
    const Result<BuiltModel> before = build_structural_model(*model), after = build_structural_model(simplified->soup);
    ASSERT_TRUE(before && after);
    EXPECT_TRUE(after->model.is_sealed) << name;
    EXPECT_EQ(after->model.regions.size(), before->model.regions.size()) << name;
    EXPECT_EQ(after->model.surfaces.size(), before->model.surfaces.size()) << name;
    EXPECT_EQ(after->model.lines.size(), before->model.lines.size()) << name;
    EXPECT_EQ(after->model.corners.size(), before->model.corners.size()) << name;
    double total = 0, expected = 0;
    for (const Region& region : before->model.regions) expected += region.volume_m3;
    for (const Region& region : after->model.regions) total += region.volume_m3;
    EXPECT_NEAR(total, expected, 1e-3 * expected) << name;
    EXPECT_TRUE(find_intersections(after->model.points, after->model.triangles).empty()) << name;
    EXPECT_GE(support::smallest_angle_deg(simplified->soup), support::smallest_angle_deg(*model)) << name;
    EXPECT_LE(report.nodes_after, report.nodes_before) << name;
  }
}

TEST(SimplifyBorders, refuses_options_out_of_their_domain) {
  EXPECT_EQ(simplify_borders({}, {0, 45}).failure().code, FailureCode::invalid_options);
  EXPECT_EQ(simplify_borders({}, {3, 0}).failure().code, FailureCode::invalid_options);
}

}  // namespace
}  // namespace strataflow
