#include "kernels/intersection/triangle_pair.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <gtest/gtest.h>

#include "base/seed.h"
#include "kernels/intersection/find_intersections.h"

namespace strataflow {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;

/// The same question answered by exact rational constructions: what two triangles share beyond their common vertices.
bool meets_improperly(const std::vector<Vec3>& points, const Triangle& a, const Triangle& b) {
  const auto at = [&](std::uint32_t v) { return Kernel::Point_3(points[v].x, points[v].y, points[v].z); };
  std::vector<std::uint32_t> shared, rest_a, rest_b;
  for (const std::uint32_t v : a) (std::find(b.begin(), b.end(), v) != b.end() ? shared : rest_a).push_back(v);
  for (const std::uint32_t v : b)
    if (std::find(a.begin(), a.end(), v) == a.end()) rest_b.push_back(v);
  const Kernel::Triangle_3 ta(at(a[0]), at(a[1]), at(a[2])), tb(at(b[0]), at(b[1]), at(b[2]));
  if (shared.size() == 3) return true;
  const auto common = CGAL::intersection(ta, tb);
  if (!common) return false;
  if (shared.empty()) return true;
  if (shared.size() == 1) return boost::get<Kernel::Point_3>(&*common) == nullptr;
  return boost::get<Kernel::Segment_3>(&*common) == nullptr;
}

struct Pair {
  std::vector<Vec3> points;
  Triangle first, second;
};

/// Two triangles on a small integer grid, so that every degenerate position is common, sharing 0, 1 or 2 vertices.
Pair random_pair(RandomStream& random, int shared, std::uint64_t side) {
  for (;;) {
    Pair pair;
    for (int i = 0; i < 6 - shared; ++i) {
      const Vec3 p{static_cast<double>(random.below(side)), static_cast<double>(random.below(side)),
                   static_cast<double>(random.below(side))};
      pair.points.push_back(p);
    }
    bool distinct = true;
    for (std::size_t i = 0; i < pair.points.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) distinct = distinct && !(pair.points[i] == pair.points[j]);
    pair.first = {0, 1, 2};
    const auto last = static_cast<std::uint32_t>(pair.points.size() - 1);
    pair.second = shared == 0 ? Triangle{3, 4, 5} : shared == 1 ? Triangle{last, 1, last - 1} : Triangle{2, last, 0};
    if (distinct && !is_degenerate(pair.points, pair.first) && !is_degenerate(pair.points, pair.second)) return pair;
  }
}

TEST(TrianglePair, equals_exact_rational_intersection_on_adversarial_pairs) {
  RandomStream random(7);
  int improper = 0;
  for (int i = 0; i < 120000; ++i) {
    const Pair pair = random_pair(random, i % 3, 3 + static_cast<std::uint64_t>(i / 3 % 4));
    const bool expected = meets_improperly(pair.points, pair.first, pair.second);
    improper += expected;
    ASSERT_EQ(meeting_of(pair.points, pair.first, pair.second) != PairMeeting::proper, expected) << "pair " << i;
    ASSERT_EQ(meeting_of(pair.points, pair.second, pair.first) != PairMeeting::proper, expected) << "pair " << i;
  }
  EXPECT_GT(improper, 10000);
}

TEST(TrianglePair, crossing_needs_an_edge_through_an_inside) {
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1}, {5, 5, 0}};
  EXPECT_EQ(meeting_of(points, {0, 1, 2}, {3, 4, 5}), PairMeeting::crossing);
}

TEST(TrianglePair, a_vertex_inside_a_neighbours_edge_touches) {
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 0, 0}, {2, -3, 0}, {3, -3, 1}};
  EXPECT_EQ(meeting_of(points, {0, 1, 2}, {3, 4, 5}), PairMeeting::touching);
}

TEST(TrianglePair, an_overlap_in_one_plane_crosses_also_when_only_borders_meet_borders) {
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
  EXPECT_EQ(meeting_of(points, {0, 1, 2}, {3, 4, 5}), PairMeeting::crossing);  // its medial triangle
  EXPECT_EQ(meeting_of(points, {0, 1, 2}, {0, 3, 5}), PairMeeting::crossing);  // the same, smaller, at one corner
  EXPECT_EQ(meeting_of(points, {3, 1, 4}, {0, 3, 5}), PairMeeting::proper);
}

TEST(TrianglePair, identical_triangles_count) {
  const std::vector<Vec3> points{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  EXPECT_EQ(meeting_of(points, {0, 1, 2}, {2, 0, 1}), PairMeeting::crossing);
}

}  // namespace
}  // namespace strataflow
