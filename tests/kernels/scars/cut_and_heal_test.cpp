// The numeric experiment of euler1999 §2.5.3 and §4.2 test 5: a clean split along a sine, healed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <set>

#include "kernels/cutting/cut_surfaces.h"
#include "kernels/intersection/find_intersections.h"
#include "kernels/scars/drop_unused_points.h"
#include "kernels/scars/remove_scars.h"
#include "support/clean_split.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

using support::CleanSplit;

struct Tally {
  std::uint64_t nodes = 0, delaunay = 0, crossed = 0, restored = 0, original_nodes = 0, nodes_left = 0;
  std::vector<std::uint64_t> valences = std::vector<std::uint64_t>(10, 0);
  double share(std::uint64_t part, std::uint64_t whole) const {
    return static_cast<double>(part) / static_cast<double>(whole);
  }
};

CleanSplit sine_split(std::uint32_t seed) {
  CleanSplit split = support::unsplit(support::jittered_sheet(70, seed));
  support::split_along(split, support::sine(35.1 + seed, 18.0, 0.2, 0.7 * seed));
  return split;
}

/// Heals everything; in arbitrary order the points are numbered at random first.
Tally heal(CleanSplit split, const ErasureOptions& erasure, std::uint32_t seed) {
  Tally tally;
  const ScarMarks marks{{}, split.inserted, {}};
  if (erasure.order == ErasureOrder::as_given) {
    const auto first =
        static_cast<std::uint32_t>(std::find(split.inserted.begin(), split.inserted.end(), 1) - split.inserted.begin());
    std::vector<std::uint32_t> number(split.soup.points.size());
    std::iota(number.begin(), number.end(), 0u);
    std::mt19937 random(seed);
    // Two copies of a node stand side by side and stay so.
    for (std::uint32_t i = first; i + 2 < number.size(); i += 2) {
      const std::uint32_t j =
          i + 2 * (static_cast<std::uint32_t>(random()) % ((static_cast<std::uint32_t>(number.size()) - i) / 2));
      std::swap(number[i], number[j]);
      std::swap(number[i + 1], number[j + 1]);
    }
    std::vector<Vec3> points(number.size());
    for (std::size_t v = 0; v < number.size(); ++v) points[number[v]] = split.soup.points[v];
    split.soup.points = std::move(points);
    for (Triangle& t : split.soup.triangles)
      for (std::uint32_t& v : t) v = number[v];
  }
  const Result<HealedSoup> healed = remove_scars(split.soup, marks, {erasure, true});
  EXPECT_TRUE(healed);
  const ErasureReport& report = healed->report.erasure;
  tally.nodes = report.erased.size();
  tally.delaunay = report.delaunay_fills;
  for (std::size_t v = 0; v < report.valence_count.size(); ++v) tally.valences[v] += report.valence_count[v];
  tally.crossed = split.crossed.size();
  tally.restored = support::restored(split, healed->soup.triangles, healed->source);
  return tally;
}

Tally experiment(const ErasureOptions& erasure) {
  Tally sum;
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const Tally one = heal(sine_split(seed), erasure, seed);
    sum.nodes += one.nodes;
    sum.delaunay += one.delaunay;
    sum.crossed += one.crossed;
    sum.restored += one.restored;
    for (std::size_t v = 0; v < one.valences.size(); ++v) sum.valences[v] += one.valences[v];
  }
  const double calls = sum.share(sum.delaunay, sum.nodes), lost = 1 - sum.share(sum.restored, sum.crossed);
  ::testing::Test::RecordProperty("delaunay_calls_percent", std::to_string(100 * calls));
  ::testing::Test::RecordProperty("not_restored_percent", std::to_string(100 * lost));
  return sum;
}

TEST(CutAndHeal, valences_after_the_suture_are_four_five_six_as_thirty_forty_thirty) {
  const Tally sum = experiment({});
  EXPECT_GT(sum.nodes, 1000u);
  EXPECT_NEAR(sum.share(sum.valences[4], sum.nodes), 0.30, 0.02);
  EXPECT_NEAR(sum.share(sum.valences[5], sum.nodes), 0.40, 0.02);
  EXPECT_NEAR(sum.share(sum.valences[6], sum.nodes), 0.30, 0.02);
  EXPECT_EQ(sum.valences[3] + sum.valences[7] + sum.valences[8] + sum.valences[9], 0u);
}

TEST(CutAndHeal, by_valence_and_through_the_node_hardly_ever_needs_delaunay_and_restores_the_mesh) {
  const Tally sum = experiment({ErasureOrder::valence_priority, QuadDiagonal::through_node});
  EXPECT_LT(sum.share(sum.delaunay, sum.nodes), 0.03);
  EXPECT_GE(sum.share(sum.restored, sum.crossed), 0.97);
}

TEST(CutAndHeal, reproduces_the_table_of_the_other_three_ways) {
  const Tally thesis = experiment({ErasureOrder::as_given, QuadDiagonal::shortest});
  EXPECT_GE(thesis.share(thesis.delaunay, thesis.nodes), 0.65);
  EXPECT_LE(thesis.share(thesis.delaunay, thesis.nodes), 0.75);
  const Tally by_valence = experiment({ErasureOrder::valence_priority, QuadDiagonal::shortest});
  EXPECT_NEAR(by_valence.share(by_valence.delaunay, by_valence.nodes), 0.438, 0.06);
  const Tally through = experiment({ErasureOrder::as_given, QuadDiagonal::through_node});
  EXPECT_NEAR(through.share(through.delaunay, through.nodes), 0.64, 0.06);
}

/// The law behind the order: along a line 4s and 6s alternate, with 5s anywhere between.
TEST(CutAndHeal, fours_and_sixes_alternate_along_the_line) {
  const CleanSplit split = sine_split(3);
  const Result<HealedSoup> sewn =
      remove_scars(split.soup, {split.lines[0], std::vector<char>(split.soup.points.size(), 0), {}});
  ASSERT_TRUE(sewn);
  std::vector<int> valence(sewn->soup.points.size(), 0);
  for (const Triangle& t : sewn->soup.triangles)
    for (const std::uint32_t v : t) ++valence[v];
  std::map<std::array<double, 3>, std::vector<std::array<double, 3>>> next;
  const auto key = [](const Vec3& p) { return std::array<double, 3>{p.x, p.y, p.z}; };
  for (const auto& [a, b] : split.lines[0]) {
    next[key(a)].push_back(key(b));
    next[key(b)].push_back(key(a));
  }
  std::map<std::array<double, 3>, int> valence_at;
  for (std::size_t v = 0; v < valence.size(); ++v) valence_at[key(sewn->soup.points[v])] = valence[v];
  auto at = std::find_if(next.begin(), next.end(), [](const auto& node) { return node.second.size() == 1; })->first;
  std::array<double, 3> from = at;
  int last = 0, fours = 0;
  for (at = next[at][0]; next[at].size() == 2;) {
    const int here = valence_at[at];
    ASSERT_TRUE(here >= 4 && here <= 6) << here;
    if (here != 5) {
      EXPECT_NE(here, last) << "two of " << here << " with only fives between";
      last = here;
    }
    fours += here == 4;
    const auto ahead = next[at][0] == from ? next[at][1] : next[at][0];
    from = at;
    at = ahead;
  }
  EXPECT_GT(fours, 50);
}

TEST(CutAndHeal, leaves_no_scar_no_new_crossing_and_the_counts_of_the_original) {
  const CleanSplit split = sine_split(2);
  const TriangleSoup original = support::jittered_sheet(70, 2);
  const Result<HealedSoup> healed = remove_scars(split.soup, {{}, split.inserted, split.original_edge});
  ASSERT_TRUE(healed);
  const TriangleSoup& soup = healed->soup;
  EXPECT_TRUE(find_intersections(soup.points, soup.triangles).empty());
  EXPECT_TRUE(healed->report.refused_lips.empty());
  // Rule R2 leaves the two ends on the border of the sheet, each a point and a triangle more.
  EXPECT_EQ(healed->report.erasure.refused.size(), 2u);
  EXPECT_EQ(soup.points.size(), original.points.size() + 2);
  EXPECT_EQ(soup.triangles.size(), original.triangles.size() + 2);
  for (const Triangle& t : soup.triangles)
    EXPECT_GT(cross(soup.points[t[1]] - soup.points[t[0]], soup.points[t[2]] - soup.points[t[0]]).z, 0);
}

TEST(CutAndHeal, with_the_original_edges_known_almost_every_triangle_comes_back) {
  std::uint64_t crossed = 0, back = 0;
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const CleanSplit split = sine_split(seed);
    const Result<HealedSoup> healed = remove_scars(split.soup, {{}, split.inserted, split.original_edge});
    ASSERT_TRUE(healed);
    crossed += split.crossed.size();
    back += support::restored(split, healed->soup.triangles, healed->source);
  }
  EXPECT_GE(static_cast<double>(back), 0.99 * static_cast<double>(crossed));
}

TEST(CutAndHeal, slits_that_cross_are_removed_one_after_another_with_at_most_thirty_percent_of_delaunay_calls) {
  std::uint64_t erased = 0, calls = 0, crossed = 0, back = 0;
  for (std::uint32_t seed = 1; seed <= 3; ++seed) {
    CleanSplit split = support::unsplit(support::jittered_sheet(70, seed));
    for (int i = 0; i < 4; ++i) {
      support::split_along(split, support::sine(12.3 + 15.1 * i, 4.7, 0.21, 0.4 * i));
      support::split_along(split,
                           [=](const Vec3& p) { return p.x - 11.7 - 15.3 * i - 5.1 * std::sin(0.17 * p.y + i); });
    }
    TriangleSoup soup = split.soup;
    std::vector<char> inserted = split.inserted;
    std::vector<std::uint32_t> source(soup.points.size());
    std::iota(source.begin(), source.end(), 0u);
    for (std::size_t line = split.lines.size(); line-- > 0;) {
      // Later lines have put nodes on the earlier ones: what a line now is, are the coinciding edges on its course.
      const Result<HealedSoup> healed =
          remove_scars(soup, {line == 0 ? std::vector<EdgePlace>{} : split.lines[line], inserted, {}});
      ASSERT_TRUE(healed);
      erased += healed->report.erasure.erased.size();
      calls += healed->report.erasure.delaunay_fills;
      soup = healed->soup;
      std::vector<char> still(soup.points.size());
      std::vector<std::uint32_t> from(soup.points.size());
      for (std::size_t v = 0; v < still.size(); ++v) {
        still[v] = inserted[healed->source[v]];
        from[v] = source[healed->source[v]];
      }
      inserted = still;
      source = from;
    }
    EXPECT_TRUE(find_intersections(soup.points, soup.triangles).empty());
    crossed += split.crossed.size();
    back += support::restored(split, soup.triangles, source);
  }
  ::testing::Test::RecordProperty("delaunay_calls_percent",
                                  std::to_string(100.0 * static_cast<double>(calls) / static_cast<double>(erased)));
  EXPECT_GE(static_cast<double>(back), 0.97 * static_cast<double>(crossed));
  EXPECT_GT(erased, 3000u);
  EXPECT_LE(static_cast<double>(calls), 0.30 * static_cast<double>(erased));
}

/// The cutter's own marks: what it inserted into a horizon goes again, whatever else it cut.
TEST(CutAndHeal, undoes_what_the_cutter_marked_in_one_surface) {
  const TriangleSoup sheet = support::jittered_sheet(20, 4);
  TriangleSoup soup = sheet;
  const std::uint32_t fault = support::add_patch(soup, "F", Role::fault);
  support::add_quad(soup, fault, {4.2, 3.1, -5}, {15.3, 16.9, -5}, {15.3, 16.9, 5}, {4.2, 3.1, 5});
  Result<CutResult> cut = cut_surfaces(soup, {.mark_inserted = true});
  ASSERT_TRUE(cut);
  // The horizon alone: another surface at a node would hold it.
  TriangleSoup horizon = cut->soup;
  horizon.triangles.clear();
  horizon.triangle_patch.clear();
  for (std::size_t t = 0; t < cut->soup.triangles.size(); ++t)
    if (cut->soup.patch_entity[cut->soup.triangle_patch[t]] == 0) {
      horizon.triangles.push_back(cut->soup.triangles[t]);
      horizon.triangle_patch.push_back(cut->soup.triangle_patch[t]);
    }
  drop_unused_points(horizon, std::vector<char>(horizon.points.size(), 0));
  ASSERT_GT(horizon.points.size(), sheet.points.size() + 20);
  ASSERT_EQ(horizon.properties.size(), 1u);
  ScarMarks marks;
  for (const double value : horizon.properties[0].values) marks.inserted_by_cut.push_back(value > 0.5);
  const Result<HealedSoup> healed = remove_scars(horizon, marks);
  ASSERT_TRUE(healed);
  EXPECT_EQ(healed->soup.points.size(), sheet.points.size());
  EXPECT_EQ(healed->soup.triangles.size(), sheet.triangles.size());
  EXPECT_TRUE(find_intersections(healed->soup.points, healed->soup.triangles).empty());
  const Result<HealedSoup> unmarked = remove_scars(horizon);
  ASSERT_TRUE(unmarked);
  EXPECT_EQ(unmarked->soup.points.size(), horizon.points.size()) << "without marks there is no slit to heal";
}

/// Cut again, by code that does not ask for marks: the first cut's stay and the second's are added.
TEST(CutAndHeal, keeps_marks_up_to_date_when_cut_again) {
  TriangleSoup soup = support::jittered_sheet(10, 4);
  support::add_quad(soup, support::add_patch(soup, "F"), {2.2, 1.1, -5}, {7.3, 8.9, -5}, {7.3, 8.9, 5}, {2.2, 1.1, 5});
  TriangleSoup once = cut_surfaces(soup, {.mark_inserted = true})->soup;
  const auto marked = [](const TriangleSoup& of) {
    std::set<std::array<double, 3>> places;
    for (std::size_t v = 0; v < of.points.size(); ++v)
      if (of.properties.at(0).values[v] > 0.5) places.insert({of.points[v].x, of.points[v].y, of.points[v].z});
    return places;
  };
  const auto first = marked(once);
  support::add_quad(once, support::add_patch(once, "G"), {7.2, 1.3, -5}, {2.3, 8.7, -5}, {2.3, 8.7, 5}, {7.2, 1.3, 5});
  once.properties[0].values.resize(once.points.size(), 0);
  const TriangleSoup twice = cut_surfaces(once)->soup;
  const auto second = marked(twice);
  EXPECT_GT(second.size(), first.size());
  EXPECT_TRUE(std::includes(second.begin(), second.end(), first.begin(), first.end()));
}

}  // namespace
}  // namespace strataflow
