#include "kernels/scars/remove_scars.h"

#include <gtest/gtest.h>

#include "base/archive.h"
#include "base/digest.h"
#include "support/clean_split.h"
#include "support/schedules.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

Digest digest(const TriangleSoup& soup) {
  ArchiveWriter bytes;
  bytes(soup);
  return digest_of(bytes.bytes());
}

/// Four unit squares around (1, 1), points of their own each, the one at lower right lifted on its far corner.
TriangleSoup four_faces() {
  TriangleSoup soup;
  const std::uint32_t patch = support::add_patch(soup, "H");
  soup.patch_entity.assign(4, 0);
  std::uint32_t face = patch;
  for (const double x : {0.0, 1.0})
    for (const double y : {0.0, 1.0}) {
      const auto first = static_cast<std::uint32_t>(soup.points.size());
      soup.points.insert(soup.points.end(), {{x, y, 0}, {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}});
      soup.triangles.insert(soup.triangles.end(), {{first, first + 1, first + 2}, {first, first + 2, first + 3}});
      soup.triangle_patch.insert(soup.triangle_patch.end(), {face, face});
      ++face;
    }
  return soup;
}

TEST(RemoveScars, keeps_a_singular_point_while_faces_still_end_there) {  // figure 2-4, rule R2
  const TriangleSoup soup = four_faces();
  const Result<HealedSoup> one_line = remove_scars(soup, {{{Vec3{1, 0, 0}, Vec3{1, 1, 0}}}, {}, {}});
  ASSERT_TRUE(one_line);
  EXPECT_EQ(one_line->report.sewn_edges, 1u);
  EXPECT_TRUE(one_line->report.erasure.erased.empty());
  EXPECT_EQ(one_line->soup.triangles.size(), soup.triangles.size());
  const auto at_centre = std::count(one_line->soup.points.begin(), one_line->soup.points.end(), Vec3{1, 1, 0});
  EXPECT_EQ(at_centre, 3) << "two of its four copies are one now";

  const Result<HealedSoup> all = remove_scars(soup);
  ASSERT_TRUE(all);
  EXPECT_EQ(all->report.sewn_edges, 4u);
  EXPECT_EQ(all->report.erasure.erased.size(), 1u);
  EXPECT_EQ(std::count(all->soup.points.begin(), all->soup.points.end(), Vec3{1, 1, 0}), 0);
  EXPECT_EQ(all->soup.points.size(), 8u);
  EXPECT_EQ(all->soup.triangles.size(), 6u);
  EXPECT_EQ(all->soup.triangle_patch, std::vector<std::uint32_t>(6, 0u));
}

TEST(RemoveScars, keeps_nodes_that_the_cut_did_not_insert_unless_told_otherwise) {
  const TriangleSoup soup = four_faces();
  const ScarMarks marks{{}, std::vector<char>(soup.points.size(), 0), {}};
  const Result<HealedSoup> kept = remove_scars(soup, marks);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->soup.triangles.size(), 8u);
  EXPECT_EQ(kept->report.erasure.refused.size(), 5u);
  EXPECT_EQ(remove_scars(soup, marks, {{}, false})->soup.triangles.size(), 6u);
}

TEST(RemoveScars, keeps_a_node_that_another_surface_uses) {
  TriangleSoup soup = four_faces();
  support::add_triangle(soup, support::add_patch(soup, "F", Role::fault), {1, 1, 0}, {1, 1, 1}, {1.5, 1.5, 1});
  const Result<HealedSoup> healed = remove_scars(soup);
  ASSERT_TRUE(healed);
  EXPECT_TRUE(healed->report.erasure.erased.empty());
  const auto& refused = healed->report.erasure.refused;
  EXPECT_TRUE(std::any_of(refused.begin(), refused.end(),
                          [](const RefusedErasure& r) { return r.reason == ErasureRefusal::shared_place; }));
}

TEST(RemoveScars, keeps_values_and_records_of_the_points_that_stay) {
  TriangleSoup soup = four_faces();
  soup.properties.push_back({"depth", "m", 1, {}});
  for (std::size_t v = 0; v < soup.points.size(); ++v)
    soup.properties[0].values.push_back(soup.points[v].x * 10 + soup.points[v].y);
  soup.border_stones = {0, 2, 14};
  soup.border_starts = {{0, 1}, {1, 2}};
  const Result<HealedSoup> healed = remove_scars(soup);
  ASSERT_TRUE(healed);
  ASSERT_EQ(healed->soup.properties[0].values.size(), healed->soup.points.size());
  for (std::size_t v = 0; v < healed->soup.points.size(); ++v) {
    EXPECT_EQ(healed->soup.properties[0].values[v], healed->soup.points[v].x * 10 + healed->soup.points[v].y);
    EXPECT_EQ(healed->soup.points[v], soup.points[healed->source[v]]);
  }
  EXPECT_EQ(healed->soup.border_stones.size(), 2u) << "point 2 was the centre";
  EXPECT_EQ(healed->soup.border_starts.size(), 1u);
}

TEST(RemoveScars, changes_nothing_the_second_time) {
  support::CleanSplit split = support::unsplit(support::jittered_sheet(20, 5));
  support::split_along(split, support::sine(10.2, 4, 0.4, 0));
  const Result<HealedSoup> once = remove_scars(split.soup, {{}, split.inserted, {}});
  ASSERT_TRUE(once);
  std::vector<char> inserted;
  for (const std::uint32_t v : once->source) inserted.push_back(split.inserted[v]);
  const Result<HealedSoup> twice = remove_scars(once->soup, {{}, inserted, {}});
  ASSERT_TRUE(twice);
  EXPECT_EQ(digest(once->soup), digest(twice->soup));
}

TEST(RemoveScars, gives_the_same_bits_on_every_schedule) {
  support::CleanSplit split = support::unsplit(support::jittered_sheet(30, 6));
  support::split_along(split, support::sine(15.2, 6, 0.3, 0));
  const Digest expected = digest(remove_scars(split.soup, {{}, split.inserted, {}})->soup);
  support::on_every_schedule([&](const char* schedule) {
    EXPECT_EQ(digest(remove_scars(split.soup, {{}, split.inserted, {}})->soup), expected) << schedule;
  });
}

TEST(RemoveScars, refuses_marks_of_the_wrong_length_and_collapsed_triangles) {
  TriangleSoup soup = four_faces();
  EXPECT_EQ(remove_scars(soup, {{}, {1, 0}, {}}).failure().code, FailureCode::invalid_input);
  soup.triangles[0] = {0, 0, 1};
  EXPECT_EQ(remove_scars(soup).failure().code, FailureCode::invalid_input);
}

}  // namespace
}  // namespace strataflow
