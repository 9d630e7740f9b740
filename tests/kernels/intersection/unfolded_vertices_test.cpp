#include "kernels/intersection/unfolded_vertices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "base/seed.h"
#include "kernels/intersection/find_intersections.h"

namespace strataflow {
namespace {

/// Triangles from the apex (point 0) to consecutive neighbours.
std::vector<Triangle> fan_around(const std::vector<std::uint32_t>& neighbours, bool is_closed) {
  std::vector<Triangle> fan;
  for (std::size_t i = 0; i + 1 < neighbours.size(); ++i) fan.push_back({0, neighbours[i], neighbours[i + 1]});
  if (is_closed) fan.push_back({neighbours.back(), neighbours.front(), 0});
  return fan;
}

bool meet_properly(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t j = i + 1; j < triangles.size(); ++j)
      if (meeting_of(points, triangles[i], triangles[j]) != PairMeeting::proper) return false;
  return true;
}

TEST(UnfoldedVertices, never_passes_a_fan_with_an_improper_pair) {
  RandomStream random(11);
  int passed = 0, improper = 0, missed = 0;
  for (int i = 0; i < 60000; ++i) {
    const std::uint32_t size = 3 + static_cast<std::uint32_t>(random.below(4));
    std::vector<Vec3> points{{2, 2, 2}};
    while (points.size() <= size) {
      const Vec3 p{static_cast<double>(random.below(5)), static_cast<double>(random.below(5)),
                   static_cast<double>(1 + random.below(3))};
      if (std::find(points.begin(), points.end(), p) == points.end()) points.push_back(p);
    }
    std::vector<std::uint32_t> neighbours;
    for (std::uint32_t v = 1; v <= size; ++v) neighbours.push_back(v);
    if (i % 3 != 0)  // else any order, mostly tangled
      std::sort(neighbours.begin(), neighbours.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::atan2(points[a].y - 2, points[a].x - 2) < std::atan2(points[b].y - 2, points[b].x - 2);
      });
    std::vector<Triangle> fan = fan_around(neighbours, random.below(2) == 0);
    if (random.below(8) == 0) std::swap(fan[0][1], fan[0][2]);
    if (random.below(2) == 0)
      for (Triangle& t : fan) std::swap(t[1], t[2]);
    bool has_flat = false;
    for (const Triangle& t : fan) has_flat = has_flat || is_degenerate(points, t);
    const bool pass = find_unfolded_vertices(points, fan)[0];
    if (has_flat) {
      EXPECT_FALSE(pass) << "fan " << i;
      continue;
    }
    const bool is_proper = meet_properly(points, fan);
    ASSERT_TRUE(is_proper || !pass) << "fan " << i;
    passed += pass;
    improper += !is_proper;
    missed += is_proper && !pass;
  }
  EXPECT_GT(passed, 4000);
  EXPECT_GT(improper, 4000);
  EXPECT_GT(missed, 0);  // it may say nothing
}

TEST(UnfoldedVertices, passes_every_vertex_of_a_wavy_sheet_and_its_border) {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i <= 8; ++i)
    for (std::uint32_t j = 0; j <= 8; ++j) points.push_back({std::sin(0.7 * i + 0.3 * j), 1.0 * i, 1.0 * j});
  for (std::uint32_t i = 0; i < 8; ++i)
    for (std::uint32_t j = 0; j < 8; ++j) {
      const std::uint32_t a = 9 * i + j;
      triangles.push_back({a, a + 9, a + 10});
      triangles.push_back({a, a + 10, a + 1});
    }
  EXPECT_EQ(find_unfolded_vertices(points, triangles), std::vector<char>(points.size(), 1));
}

/// Points beyond what one task looks at, some of them folded, asked for in two numberings of points and triangles.
TEST(UnfoldedVertices, does_not_depend_on_how_a_large_sheet_is_numbered) {
  constexpr std::uint32_t n = 160;
  RandomStream random(7);
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j)
      points.push_back({i + (random.below(9) == 0 ? 2.5 : 0.0), 1.0 * j, 0.3 * static_cast<double>(random.below(8))});
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = (n + 1) * i + j, b = a + n + 1;
      triangles.push_back({a, b, b + 1});
      triangles.push_back({a, b + 1, a + 1});
    }
  const std::vector<char> expected = find_unfolded_vertices(points, triangles);
  const auto passed = std::count(expected.begin(), expected.end(), 1);
  EXPECT_GT(passed, 4000);
  EXPECT_GT(static_cast<std::ptrdiff_t>(points.size()) - passed, 4000);
  const auto shuffled = [&](std::size_t count) {
    std::vector<std::uint32_t> place(count);
    std::iota(place.begin(), place.end(), 0u);
    for (std::size_t i = count; i > 1; --i) std::swap(place[i - 1], place[random.below(i)]);
    return place;
  };
  const std::vector<std::uint32_t> number = shuffled(points.size()), order = shuffled(triangles.size());
  std::vector<Vec3> other_points(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) other_points[number[v]] = points[v];
  std::vector<Triangle> other_triangles;
  for (const std::uint32_t t : order)
    other_triangles.push_back({number[triangles[t][0]], number[triangles[t][1]], number[triangles[t][2]]});
  const std::vector<char> found = find_unfolded_vertices(other_points, other_triangles);
  for (std::size_t v = 0; v < points.size(); ++v) ASSERT_EQ(found[number[v]], expected[v]) << "point " << v;
}

TEST(UnfoldedVertices, leaves_out_a_fan_that_turns_twice) {
  const std::vector<Vec3> points{{0, 0, 0}, {2, 0, 0}, {-1, 2, 1}, {-1, -2, 2}, {3, 1, 3}, {-2, 2, 4}, {-1, -3, -1}};
  EXPECT_FALSE(find_unfolded_vertices(points, fan_around({1, 2, 3, 4, 5, 6}, true))[0]);
  EXPECT_FALSE(find_unfolded_vertices(points, fan_around({1, 2, 3, 4, 5, 6}, false))[0]);
  EXPECT_TRUE(find_unfolded_vertices(points, fan_around({1, 2, 3}, true))[0]);
}

TEST(UnfoldedVertices, leaves_out_an_edge_of_three_triangles) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
  EXPECT_EQ(find_unfolded_vertices(points, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}), (std::vector<char>{0, 0, 1, 1, 1}));
}

TEST(UnfoldedVertices, accepts_points_without_triangles) {
  EXPECT_EQ(find_unfolded_vertices({{0, 0, 0}}, {}), std::vector<char>{0});
}

}  // namespace
}  // namespace strataflow
