// Curves, tips and the graph of segments: everything before there are triangles.
#include <gtest/gtest.h>

#include "kernels/quads/plan/open_corners.h"
#include "kernels/quads/plan/plan_curves.h"
#include "kernels/quads/plan/plan_graph.h"
#include "kernels/quads/plan/plan_samples.h"
#include "kernels/quads/plan/snap_tips.h"

namespace strataflow {
namespace {

using namespace plan_samples;

PlanGraph cleaned(const std::vector<Polyline>& lines, double edge_m, const std::vector<PointSet>& points = {}) {
  PlanCurves curves = *plan_curves(lines, points, edge(edge_m));
  snap_tips(curves, 0.1 * edge_m);
  PlanGraph graph = *arrange_curves(std::move(curves));
  contract_short_edges(graph, 0.1 * edge_m);
  return graph;
}

TEST(PlanCurves, put_a_box_around_curves_without_outline) {
  const auto curves = plan_curves(std::vector{fault("a", {{0, 0, 5}, {100, 50, 7}})}, {}, edge(10));
  ASSERT_TRUE(curves);
  ASSERT_EQ(curves->curves.size(), 2u);
  EXPECT_EQ(curves->curves[0].points[1], (Vec3{100, 50, 0}));
  EXPECT_EQ(curves->curves[1].points[0], (Vec3{-30, -30, 0}));
  EXPECT_EQ(curves->curves[1].points[2], (Vec3{130, 80, 0}));
  EXPECT_EQ(changes_of_kind(curves->changes, "added"), 1);
}

TEST(PlanCurves, make_a_circle_of_a_well_that_goes_straight_down_only) {
  const std::vector<Polyline> lines{square(100), line("W1", Role::well, {{50, 50, 0}, {50.5, 50, -800}}),
                                    line("W2", Role::well, {{20, 20, 0}, {60, 20, -800}})};
  const auto curves = plan_curves(lines, {}, edge(10));
  ASSERT_TRUE(curves);
  ASSERT_EQ(curves->curves.size(), 3u);
  EXPECT_EQ(curves->curves[1].points.size(), 12u);
  for (const Vec3& p : curves->curves[1].points) EXPECT_NEAR(length(p - Vec3{50, 50, 0}), 10, 1e-12);
  EXPECT_FALSE(curves->curves[2].is_closed);
}

TEST(PlanCurves, close_outlines_and_drop_what_has_no_length) {
  const std::vector<Polyline> lines{line("o", Role::outline, {{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}}),
                                    fault("stick", {{3, 3, 0}, {3, 3, -9}})};
  const auto curves = plan_curves(lines, {}, edge(1));
  ASSERT_TRUE(curves);
  ASSERT_EQ(curves->curves.size(), 1u);
  EXPECT_TRUE(curves->curves[0].is_closed);
  EXPECT_EQ(changes_of_kind(curves->changes, "closed"), 1);
  EXPECT_EQ(changes_of_kind(curves->changes, "dropped"), 1);
}

TEST(PlanCurves, refuse_nothing_nan_and_absurd_edge_lengths_by_name) {
  EXPECT_FALSE(plan_curves({}, {}, edge(1)));
  const auto broken = plan_curves(std::vector{fault("F7", {{0, 0, 0}, {NAN, 1, 0}})}, {}, edge(1));
  ASSERT_FALSE(broken);
  EXPECT_NE(broken.failure().what.find("F7"), std::string::npos);
  EXPECT_EQ(plan_curves(std::vector{square(10)}, {}, edge(1e-6)).failure().code, FailureCode::invalid_options);
  EXPECT_EQ(plan_curves(std::vector{square(10)}, {}, edge(100)).failure().code, FailureCode::invalid_options);
  EXPECT_EQ(plan_curves(std::vector{square(10)}, {}, edge(NAN)).failure().code, FailureCode::invalid_options);
}

TEST(PlanCurves, trace_sticks_by_their_first_points) {
  const std::vector<Polyline> sticks{fault("F", {{0, 0, 5}, {1, 1, 9}}), fault("F", {{4, 0, 5}, {5, 1, 9}})};
  const Polyline trace = trace_of_sticks(sticks);
  EXPECT_EQ(trace.name, "F");
  EXPECT_EQ(trace.role, Role::fault);
  EXPECT_EQ(trace.points, (std::vector<Vec3>{{0, 0, 5}, {4, 0, 5}}));
}

TEST(SnapTips, an_end_that_stops_short_is_led_onto_the_curve_and_listed) {
  PlanCurves curves = *plan_curves(
      std::vector{square(100), fault("a", {{20, 50, 0}, {80, 50, 0}}), fault("b", {{50, 90, 0}, {50, 50.7, 0}})}, {},
      edge(10));
  snap_tips(curves, 1);
  EXPECT_EQ(curves.curves[2].points.back(), (Vec3{50, 50, 0}));
  EXPECT_EQ(curves.curves[1].points[1], (Vec3{50, 50, 0}));
  ASSERT_EQ(curves.changes.size(), 1u);
  EXPECT_EQ(curves.changes[0].kind, "snapped");
  EXPECT_EQ(curves.changes[0].what, "end of b at (50.00, 50.70)");
  EXPECT_EQ(curves.changes[0].why, "it ends near a, by 0.7 m");
}

TEST(SnapTips, an_end_that_juts_out_is_cut_off) {
  PlanCurves curves = *plan_curves(
      std::vector{square(100), fault("a", {{20, 50, 0}, {80, 50, 0}}), fault("b", {{50, 90, 0}, {50, 49.2, 0}})}, {},
      edge(10));
  snap_tips(curves, 1);
  EXPECT_EQ(curves.curves[2].points.back(), (Vec3{50, 50, 0}));
  EXPECT_EQ(changes_of_kind(curves.changes, "trimmed"), 1);
}

TEST(SnapTips, ends_prefer_ends_and_what_is_further_stays) {
  PlanCurves curves =
      *plan_curves(std::vector{square(100), fault("a", {{20, 50, 0}, {50, 50, 0}}),
                               fault("b", {{50.6, 50.4, 0}, {80, 60, 0}}), fault("c", {{30, 52, 0}, {30, 90, 0}})},
                   {}, edge(10));
  snap_tips(curves, 1);
  EXPECT_EQ(curves.curves[1].points.back(), curves.curves[2].points.front());
  EXPECT_EQ(curves.curves[3].points.front(), (Vec3{30, 52, 0}));
}

TEST(PlanGraphTest, crossings_are_nodes_and_overlaps_carry_both_features) {
  const PlanGraph graph = cleaned({square(100), fault("a", {{20, 50, 0}, {80, 50, 0}}),
                                   fault("b", {{40, 50, 0}, {60, 50, 0}}), fault("c", {{50, 20, 0}, {50, 80, 0}})},
                                  10);
  EXPECT_EQ(graph.points.size(), 4u + 4 + 2 + 1);
  int both = 0;
  for (const auto& s : graph.segments) both += s.features == std::vector<std::uint32_t>{1, 2};
  EXPECT_EQ(both, 2);
}

/// R8, with the next three: short edges go, ends and junctions stay, nothing crosses.
TEST(ContractShortEdges, drops_bends_within_the_limit_and_keeps_the_others) {
  // A bend of 0.5 m goes, one of 3 m stays.
  const PlanGraph graph = cleaned(
      {square(100), fault("a", {{20, 50, 0}, {24, 50.5, 0}, {28, 50, 0}, {50, 50, 0}, {55, 53, 0}, {60, 50, 0}})}, 10);
  std::vector<Vec3> on;
  for (const auto& s : graph.segments)
    if (s.features == std::vector<std::uint32_t>{1}) on.push_back(graph.points[s.b]);
  EXPECT_EQ(std::count_if(on.begin(), on.end(), [](const Vec3& p) { return p.y > 50.2 && p.y < 51; }), 0);
  EXPECT_EQ(
      std::count(on.begin(), on.end(), Vec3{55, 53, 0}) > 0 || std::count_if(graph.points.begin(), graph.points.end(),
                                                                             [](const Vec3& p) {
                                                                               return p == Vec3{55, 53, 0};
                                                                             }) > 0,
      true);
  EXPECT_EQ(changes_of_kind(graph.changes, "contracted"), 1);
}

TEST(ContractShortEdges, merges_junctions_within_the_limit_but_not_beyond) {
  const auto junctions = [](double apart) {
    const PlanGraph graph =
        cleaned({square(100), fault("a", {{10, 50, 0}, {90, 50, 0}}), fault("b", {{50, 50, 0}, {50, 90, 0}}),
                 fault("c", {{50 + apart, 50, 0}, {55, 10, 0}})},
                10);
    int count = 0;
    for (const auto& around : graph.incident()) count += around.size() > 2;
    return count;
  };
  EXPECT_EQ(junctions(0.9), 1);
  EXPECT_EQ(junctions(1.2), 2);
}

TEST(ContractShortEdges, never_lets_a_curve_pass_over_a_point) {
  // The bend of `a` would go over the end of `b`.
  const PlanGraph graph = cleaned({square(100), fault("a", {{20, 50, 0}, {25, 50.9, 0}, {30, 50, 0}, {80, 50, 0}}),
                                   fault("b", {{25, 50.6, 0}, {25, 20, 0}})},
                                  10);
  for (const auto& s : graph.segments)
    for (const auto& t : graph.segments)
      EXPECT_FALSE(cross_properly(graph.points[s.a], graph.points[s.b], graph.points[t.a], graph.points[t.b]));
}

TEST(ContractShortEdges, leaves_a_fault_that_is_short_altogether) {
  const PlanGraph graph = cleaned({square(100), fault("a", {{50, 50, 0}, {50.4, 50, 0}})}, 10);
  EXPECT_EQ(graph.segments.size(), 5u);
}

/// The angle between a and b where they meet at (20, 50), degrees.
double opened_angle(double deg, double limit_m, std::vector<Polyline> more = {}) {
  const double x = 60 * std::cos(deg * 0.017453292519943295), y = 60 * std::sin(deg * 0.017453292519943295);
  more.insert(more.begin(),
              {square(100), fault("a", {{20, 50, 0}, {80, 50, 0}}), fault("b", {{20, 50, 0}, {20 + x, 50 + y, 0}})});
  PlanGraph graph = cleaned(more, 10);
  open_acute_corners(graph, limit_m, 20);
  std::vector<double> angles;
  for (const auto& s : graph.segments)
    for (const auto& [p, q] : {std::pair(s.a, s.b), std::pair(s.b, s.a)})
      if (graph.points[p] == Vec3{20, 50, 0})
        angles.push_back(std::atan2(graph.points[q].y - 50, graph.points[q].x - 20));
  std::sort(angles.begin(), angles.end());
  for (const auto& s : graph.segments)
    for (const auto& t : graph.segments)
      EXPECT_FALSE(cross_properly(graph.points[s.a], graph.points[s.b], graph.points[t.a], graph.points[t.b]));
  return angles.size() < 2 ? 0 : (angles[1] - angles[0]) * 57.29577951308232;
}

TEST(OpenAcuteCorners, opens_a_corner_as_far_as_the_limit_lets_both_sides_bend) {
  EXPECT_NEAR(opened_angle(15, 1), 20, 0.6);
  EXPECT_NEAR(opened_angle(5, 1), 5 + 2 * std::atan(0.1) * 57.29577951308232, 0.1);
  EXPECT_NEAR(opened_angle(5, 0), 5, 1e-9);
  EXPECT_NEAR(opened_angle(25, 1), 25, 1e-9);
}

TEST(OpenAcuteCorners, passes_over_nothing_that_lies_beside) {
  // The bend of a fault just above b and one just below a leave little room.
  const double opened = opened_angle(
      5, 1,
      {fault("c", {{26, 90, 0}, {30, 51.2, 0}, {34, 90, 0}}), fault("d", {{26, 10, 0}, {30, 49.8, 0}, {34, 10, 0}})});
  EXPECT_LT(opened, 7);
  EXPECT_GE(opened, 5 - 1e-9);
}

}  // namespace
}  // namespace strataflow
