#include "kernels/remeshing/dual/component_points.h"

#include <set>

#include "kernels/remeshing/dual/dual_samples.h"

namespace strataflow {
namespace {

using sample::Dual;
using sample::dual_of;
using sample::Patches;

/// A star with three arms, a site in the middle and one at each tip: the middle cell touches the border in three
/// places.
Dual three_arms(const MergeOptions& options) {
  std::vector<Vec3> sites{{0, 0, 0}};
  for (int k = 0; k < 3; ++k) sites.push_back({0.9 * std::cos(2.0943951 * k), 0.9 * std::sin(2.0943951 * k), 0});
  return dual_of(Patches().add("S", Role::horizon, sample::star(3, 0.2)).model(), sites, options);
}

std::size_t points_of_site(const Dual& dual, std::uint32_t site) {
  return static_cast<std::size_t>(std::count_if(dual.points.points.begin(), dual.points.points.end(),
                                                [&](const DualPoint& p) { return p.site == site; }));
}

TEST(ComponentPoints, a_component_that_touches_three_lines_gets_one_point_if_asked_and_three_if_not) {
  const Dual merged = three_arms({}), apart = three_arms(sample::no_merging());
  EXPECT_EQ(points_of_site(merged, 0), 1u);
  EXPECT_EQ(points_of_site(apart, 0), 3u);
  ASSERT_EQ(merged.points.merges.size(), 1u);
  EXPECT_EQ(merged.points.merges[0].kind, MergeKind::beyond_two_points);
  EXPECT_EQ(merged.points.merges[0].lines, (std::vector<std::uint32_t>{0}));
  sample::expect_conforming(merged.model, merged.mesh);
  sample::expect_conforming(apart.model, apart.mesh);
}

TEST(ComponentPoints, no_component_keeps_more_than_two_points) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const StructuralModel model =
        seed % 2 ? sample::junction() : Patches().add("S", Role::horizon, sample::random_star(seed)).model();
    const Dual dual = dual_of(model, sample::sites_in_box(model, 6 + seed, seed));
    for (std::uint32_t c = 0; c < dual.components.surfaces.size(); ++c) {
      std::set<std::uint32_t> own;
      if (dual.points.surface_point[c] != no_index) own.insert(dual.points.surface_point[c]);
      for (const std::uint32_t l : dual.components.touched_by(c)) {
        if (dual.points.line_point[l] != no_index) own.insert(dual.points.line_point[l]);
        for (const std::uint32_t corner : dual.components.corners_of(l)) own.insert(dual.points.corner_point[corner]);
      }
      EXPECT_GE(own.size(), 1u);
      EXPECT_LE(own.size(), 2u);
    }
  }
}

TEST(ComponentPoints, unmerged_corners_stay_where_they_are) {
  const Dual dual = dual_of(sample::junction(), sample::sites_in_box(sample::junction(), 25, 8), sample::no_merging());
  for (std::size_t c = 0; c < dual.model.corners.size(); ++c)
    EXPECT_EQ(dual.points.points[dual.points.corner_point[c]].position,
              dual.model.points[dual.model.corners[c].vertex]);
}

TEST(ComponentPoints, linked_corners_of_a_cell_become_one) {
  const StructuralModel model = sample::junction();
  const Dual dual = dual_of(model, {{0.5, 0, 0}, {9, 9, 9}});
  const std::set<std::uint32_t> points(dual.points.corner_point.begin(), dual.points.corner_point.end());
  EXPECT_EQ(points.size(), 1u);
  ASSERT_FALSE(dual.points.merges.empty());
  EXPECT_EQ(dual.points.merges[0].kind, MergeKind::linked_corners);
  EXPECT_EQ(dual.points.merges[0].corners.size(), model.corners.size());
}

/// Sheets one above the other, 16 squares each.
StructuralModel two_sheets(double gap, Role other = Role::horizon) {
  return Patches()
      .add("H1", Role::horizon, sample::rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 4, 4))
      .add("H2", other, sample::rectangle({0, 0, gap}, {1, 0, 0}, {0, 1, 0}, 4, 4))
      .model();
}

std::vector<Vec3> grid_sites(double z) {
  std::vector<Vec3> sites;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) sites.push_back({(i + 0.5 + 0.1 * (j % 2)) / 4.2, (j + 0.5) / 4, z});
  return sites;
}

TEST(ComponentPoints, sheets_nearer_than_the_resolution_are_joined_and_no_others) {
  for (const double gap : {0.01, 0.03, 0.049, 0.051, 0.08}) {
    const Dual dual = dual_of(two_sheets(gap), grid_sites(gap / 2), {.resolution_m = 0.05});
    EXPECT_EQ(dual.points.merges.size(), gap < 0.05 ? 16u : 0u) << gap;
    EXPECT_EQ(dual.points.points.size(), gap < 0.05 ? 16u : 32u) << gap;
    for (const PointMerge& merge : dual.points.merges) EXPECT_NEAR(merge.distance_m, gap, 1e-12);
  }
}

TEST(ComponentPoints, sheets_of_other_roles_are_joined_only_if_asked) {
  const StructuralModel model = two_sheets(0.01, Role::fault);
  EXPECT_TRUE(dual_of(model, grid_sites(0), {.resolution_m = 0.05}).points.merges.empty());
  EXPECT_EQ(dual_of(model, grid_sites(0), {.resolution_m = 0.05, .merges_different_roles = true}).points.merges.size(),
            16u);
}

/// A horizon offset by `throw_m` at a fault.
StructuralModel step(double throw_m) {
  Patches patches;
  patches.add("H-left", Role::horizon, sample::rectangle({0.5, 0, 0}, {-0.5, 0, 0}, {0, 1, 0}, 4, 8));
  patches.add("H-right", Role::horizon, sample::rectangle({0.5, 0, throw_m}, {0.5, 0, 0}, {0, 1, 0}, 4, 8));
  patches.add("F", Role::fault, sample::rectangle({0.5, 0, 0}, {0, 1, 0}, {0, 0, -0.4}, 8, 3));
  patches.add("F", Role::fault, sample::rectangle({0.5, 0, 0}, {0, 1, 0}, {0, 0, throw_m}, 8, 1));
  patches.add("F", Role::fault, sample::rectangle({0.5, 0, throw_m}, {0, 1, 0}, {0, 0, 0.4}, 8, 3));
  return patches.model();
}

TEST(ComponentPoints, a_throw_below_the_resolution_is_cancelled_and_a_larger_one_kept) {
  std::vector<Vec3> sites;
  for (int j = 0; j < 4; ++j)
    for (const double x : {0.12, 0.5, 0.88}) sites.push_back({x, (j + 0.5) / 4, x == 0.5 ? 0.02 : 0});
  for (const double throw_m : {0.01, 0.03, 0.05, 0.07}) {
    const Dual dual = dual_of(step(throw_m), sites, {.resolution_m = 0.04});
    std::size_t joined = 0;
    for (const PointMerge& merge : dual.points.merges) joined += merge.kind == MergeKind::resolution ? 1 : 0;
    EXPECT_EQ(joined > 0, throw_m < 0.04) << throw_m;
    sample::expect_conforming(dual.model, dual.mesh);
  }
}

TEST(ComponentPoints, sheets_that_only_touch_at_one_end_of_a_cell_are_joined_no_farther_than_they_may_move) {
  // A wedge that opens from 0.02 to 0.32 across one cell: half way along it is wider than what a point may move.
  const StructuralModel wedge = Patches()
                                    .add("H", Role::horizon, sample::rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 8, 8))
                                    .add("H", Role::horizon,
                                         sample::rectangle({0, 0, 0.02}, {1, 0, 0.3}, {0, 1, 0}, 8, 8))
                                    .model();
  const std::vector<Vec3> one{{0.5, 0.5, 0}, {90, 90, 90}};
  MergeOptions options{.merges_linked_corners = false, .merges_beyond_two_points = false, .resolution_m = 0.05};
  const auto inner_merges = [&] {
    std::size_t merges = 0;
    for (const PointMerge& merge : dual_of(wedge, one, options).points.merges) merges += merge.lines.empty() ? 0u : 1u;
    return merges;
  };
  EXPECT_GT(inner_merges(), 0u);
  options.most_move_m = 0.05;
  EXPECT_EQ(inner_merges(), 0u);
  options.most_move_m = 1;
  EXPECT_GT(inner_merges(), 0u);
}

TEST(ComponentPoints, cells_that_are_to_stay_unmerged_do) {
  MergeOptions options{.resolution_m = 0.05};
  options.unmerged_sites = {0, 1, 1};
  const Dual dual = dual_of(two_sheets(0.01), grid_sites(0.005), options);
  EXPECT_EQ(dual.points.merges.size(), 14u);
  for (const PointMerge& merge : dual.points.merges) EXPECT_TRUE(merge.site == 0 || merge.site > 2) << merge.site;
}

TEST(ComponentPoints, a_border_has_its_point_where_it_bends) {
  // The border of a square runs round its corner inside the one cell that holds it; the others see straight pieces.
  const StructuralModel square =
      Patches().add("S", Role::horizon, sample::rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 10, 10)).model();
  ASSERT_TRUE(square.corners.empty());
  MergeOptions options = sample::no_merging();
  for (const bool follows : {true, false}) {
    options.follows_bends = follows;
    const Dual dual = dual_of(square, {{0.1, 0.2, 0}, {0.8, 0.2, 0}, {0.1, 0.8, 0}, {0.8, 0.8, 0}}, options);
    std::size_t at_bends = 0;
    for (const DualPoint& p : dual.points.points)
      for (const Vec3& bend : {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{1, 1, 0}})
        at_bends += p.position == bend;
    EXPECT_EQ(at_bends, follows ? 4u : 0u);
  }
}

TEST(ComponentPoints, the_box_stays_where_it_is) {
  const StructuralModel model = sample::reference("A4", 160);
  const Dual dual = dual_of(model, sample::sites_in_box(model, 30, 4), {.resolution_m = 100});
  std::size_t corners = 0;
  for (std::size_t c = 0; c < model.corners.size(); ++c) {
    const Vec3& p = model.points[model.corners[c].vertex];
    const auto is_end = [](double x, double low, double high) { return x == low || x == high; };
    if (!is_end(p.x, model.box.low.x, model.box.high.x) || !is_end(p.y, model.box.low.y, model.box.high.y) ||
        !is_end(p.z, model.box.low.z, model.box.high.z))
      continue;
    ++corners;
    EXPECT_EQ(dual.points.points[dual.points.corner_point[c]].position, p);
  }
  EXPECT_EQ(corners, 8u);
}

}  // namespace
}  // namespace strataflow
