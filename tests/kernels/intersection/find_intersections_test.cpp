#include "kernels/intersection/find_intersections.h"

#include <gtest/gtest.h>

#include "base/seed.h"
#include "kernels/intersection/bounding_volume_tree.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

struct Cloud {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
};

/// Triangles over few shared points of a small grid: neighbours, coplanar overlaps and duplicates all occur.
Cloud tangled_cloud(std::uint64_t seed, std::uint32_t point_count, std::uint32_t triangle_count) {
  RandomStream random(seed);
  Cloud cloud;
  while (cloud.points.size() < point_count) {
    const Vec3 p{static_cast<double>(random.below(9)), static_cast<double>(random.below(9)), static_cast<double>(random.below(9))};
    if (std::find(cloud.points.begin(), cloud.points.end(), p) == cloud.points.end()) cloud.points.push_back(p);
  }
  while (cloud.triangles.size() < triangle_count) {
    const auto v = [&] { return static_cast<std::uint32_t>(random.below(point_count)); };
    const Triangle t{v(), v(), v()};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) cloud.triangles.push_back(t);
  }
  return cloud;
}

std::vector<std::array<std::uint32_t, 3>> listed(const std::vector<IntersectingPair>& pairs) {
  std::vector<std::array<std::uint32_t, 3>> list;
  for (const IntersectingPair& p : pairs) list.push_back({p.first, p.second, static_cast<std::uint32_t>(p.meeting)});
  return list;
}

TEST(FindIntersections, equals_brute_force) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Cloud cloud = tangled_cloud(seed, 60, 150);
    std::vector<IntersectingPair> expected;
    for (std::uint32_t t = 0; t < cloud.triangles.size(); ++t)
      for (std::uint32_t u = t + 1; u < cloud.triangles.size(); ++u) {
        if (is_degenerate(cloud.points, cloud.triangles[t]) || is_degenerate(cloud.points, cloud.triangles[u])) continue;
        const PairMeeting meeting = meeting_of(cloud.points, cloud.triangles[t], cloud.triangles[u]);
        if (meeting != PairMeeting::proper) expected.push_back({t, u, meeting});
      }
    // The tree may ask a pair the other way round; what they share is the same, how it is classed must be too.
    EXPECT_EQ(listed(find_intersections(cloud.points, cloud.triangles)), listed(expected)) << "seed " << seed;
  }
}

/// A sheet whose points are moved so far that it folds over itself: almost all pairs are neighbours.
Cloud crumpled_sheet(std::uint64_t seed, std::uint32_t side, std::uint64_t reach) {
  RandomStream random(seed);
  Cloud cloud;
  for (std::uint32_t i = 0; i <= side; ++i)
    for (std::uint32_t j = 0; j <= side; ++j)
      cloud.points.push_back({static_cast<double>(4 * i + random.below(reach)), static_cast<double>(4 * j + random.below(reach)),
                              static_cast<double>(random.below(4)) / 2 + 1e-3 * (i * side + j)});
  for (std::uint32_t i = 0; i < side; ++i)
    for (std::uint32_t j = 0; j < side; ++j) {
      const std::uint32_t a = i * (side + 1) + j, b = a + side + 1;
      cloud.triangles.push_back({a, b, b + 1});
      cloud.triangles.push_back(random.below(9) == 0 ? Triangle{a, a + 1, b + 1} : Triangle{a, b + 1, a + 1});
    }
  return cloud;
}

TEST(FindIntersections, equals_brute_force_on_sheets_that_fold) {
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const Cloud cloud = crumpled_sheet(seed, 12, 2 + seed % 8);
    std::vector<IntersectingPair> expected;
    for (std::uint32_t t = 0; t < cloud.triangles.size(); ++t)
      for (std::uint32_t u = t + 1; u < cloud.triangles.size(); ++u) {
        if (is_degenerate(cloud.points, cloud.triangles[t]) || is_degenerate(cloud.points, cloud.triangles[u])) continue;
        const PairMeeting meeting = meeting_of(cloud.points, cloud.triangles[t], cloud.triangles[u]);
        if (meeting != PairMeeting::proper) expected.push_back({t, u, meeting});
      }
    EXPECT_EQ(listed(find_intersections(cloud.points, cloud.triangles)), listed(expected)) << "seed " << seed;
    if (seed % 8 != 1 && seed % 8 != 2) {
      EXPECT_EQ(expected.empty(), seed % 8 == 0) << "seed " << seed;
    }
  }
}

TEST(FindIntersections, does_not_depend_on_the_schedule) {
  const Cloud cloud = tangled_cloud(99, 300, 900);
  const auto expected = listed(find_intersections(cloud.points, cloud.triangles));
  EXPECT_GT(expected.size(), 1000u);
  support::on_every_schedule(
      [&](const char* schedule) { EXPECT_EQ(listed(find_intersections(cloud.points, cloud.triangles)), expected) << schedule; });
}

TEST(FindIntersectionsOf, changed_triangles_finds_the_pairs_with_one_of_them) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const Cloud cloud = tangled_cloud(seed, 60, 150);
    RandomStream random(seed);
    std::vector<char> is_changed(cloud.triangles.size());
    for (char& changed : is_changed) changed = random.below(1 + seed % 10) == 0;
    std::vector<IntersectingPair> expected = find_intersections(cloud.points, cloud.triangles);
    std::erase_if(expected, [&](const IntersectingPair& p) { return !is_changed[p.first] && !is_changed[p.second]; });
    EXPECT_EQ(listed(find_intersections_of(cloud.points, cloud.triangles, is_changed)), listed(expected)) << "seed " << seed;
  }
}

TEST(FindIntersectionsOf, nothing_changed_finds_nothing) {
  const Cloud cloud = tangled_cloud(1, 60, 150);
  EXPECT_TRUE(find_intersections_of(cloud.points, cloud.triangles, std::vector<char>(cloud.triangles.size(), 0)).empty());
  EXPECT_TRUE(find_intersections_of({}, {}, {}).empty());
}

TEST(FindIntersectionsOf, changed_triangles_does_not_depend_on_the_schedule) {
  const Cloud cloud = tangled_cloud(98, 300, 900);
  std::vector<char> is_changed(cloud.triangles.size());
  for (std::size_t t = 0; t < is_changed.size(); ++t) is_changed[t] = t % 3 == 0;
  const auto expected = listed(find_intersections_of(cloud.points, cloud.triangles, is_changed));
  EXPECT_FALSE(expected.empty());
  support::on_every_schedule([&](const char* schedule) {
    EXPECT_EQ(listed(find_intersections_of(cloud.points, cloud.triangles, is_changed)), expected) << schedule;
  });
}

TEST(FindIntersections, accepts_no_triangles) { EXPECT_TRUE(find_intersections({}, {}).empty()); }

TEST(BoundingVolumeTree, finds_every_overlapping_item_once) {
  RandomStream random(5);
  std::vector<FloatBox> boxes;
  for (int i = 0; i < 1000; ++i) {
    Box3 box;
    const Vec3 p{random.unit(), random.unit(), random.unit()};
    box.take(p);
    box.take(p + 0.1 * Vec3{random.unit(), random.unit(), random.unit()});
    boxes.push_back(enclosing(box));
  }
  const BoundingVolumeTree tree(boxes);
  for (const FloatBox& query : boxes) {
    std::vector<std::uint32_t> found, expected;
    tree.visit_items(query, [&](std::uint32_t item) { found.push_back(item); });
    for (std::uint32_t i = 0; i < boxes.size(); ++i)
      if (overlap(boxes[i], query)) expected.push_back(i);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

TEST(BoundingVolumeTree, rounds_boxes_outward) {
  Box3 box;
  box.take(Vec3{0.1, 1e8 + 1, -0.1});
  const FloatBox out = enclosing(box);
  EXPECT_LE(static_cast<double>(out.low[0]), 0.1);
  EXPECT_GE(static_cast<double>(out.high[1]), 1e8 + 1);
  EXPECT_LE(static_cast<double>(out.low[2]), -0.1);
}

}  // namespace
}  // namespace strataflow
