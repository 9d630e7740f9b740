#include "kernels/scars/polygon_fill.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

namespace strataflow {
namespace {

std::vector<std::uint32_t> around(std::size_t n) {
  std::vector<std::uint32_t> polygon(n);
  std::iota(polygon.begin(), polygon.end(), 0u);
  return polygon;
}

double area(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
  double sum = 0;
  for (const Triangle& t : triangles) sum += cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]]).z / 2;
  return sum;
}

/// Whether d is inside the circle through a b c, counter-clockwise; clearly so, beyond rounding.
bool is_inside_circle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto row = [&](const Vec3& p) { return Vec3{p.x - d.x, p.y - d.y, dot(p - d, p - d)}; };
  return dot(row(a), cross(row(b), row(c))) > 1e-9;
}

TEST(PolygonFill, of_a_triangle_is_that_triangle) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const auto fill = fill_polygon(points, around(3));
  ASSERT_TRUE(fill);
  EXPECT_EQ(*fill, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(PolygonFill, keeps_the_sense_of_the_polygon_in_every_plane) {
  for (const bool reversed : {false, true})
    for (int shift = 0; shift < 3; ++shift) {
      std::vector<Vec3> points;
      for (const auto& [u, v] : std::vector<std::pair<double, double>>{{0, 0}, {2, 0}, {2, 1}, {1, 0.4}, {0, 1}}) {
        Vec3 p;
        p[shift] = u;
        p[(shift + 1) % 3] = v;
        points.push_back(p);
      }
      if (reversed) std::reverse(points.begin(), points.end());
      const auto fill = fill_polygon(points, around(5));
      ASSERT_TRUE(fill);
      EXPECT_EQ(fill->size(), 3u);
      for (const Triangle& t : *fill)
        EXPECT_EQ(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]])[(shift + 2) % 3] > 0, !reversed);
    }
}

TEST(PolygonFill, refuses_a_polygon_that_crosses_or_touches_itself) {
  EXPECT_FALSE(fill_polygon({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0.5, 0}}, around(5)));
  EXPECT_FALSE(fill_polygon({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}}, around(5))) << "touches a side";
  EXPECT_FALSE(fill_polygon({{0, 0, 0}, {4, 0, 0}, {2, 0, 0}, {2, 2, 0}}, around(4))) << "turns back on itself";
  EXPECT_FALSE(fill_polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, around(3))) << "no area";
}

TEST(PolygonFill, is_delaunay_in_a_plane) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 200; ++trial) {
    const std::size_t n = 5 + trial % 6;
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < n; ++i) {  // convex, so that no side stands in the way
      const double angle =
          6.283 * (static_cast<double>(i) + 0.8 * static_cast<double>(random() % 1000) / 1000) / static_cast<double>(n);
      points.push_back({3 * std::cos(angle), 2 * std::sin(angle), 0});
    }
    const auto fill = fill_polygon(points, around(n));
    ASSERT_TRUE(fill);
    for (const Triangle& t : *fill)
      for (std::size_t v = 0; v < n; ++v)
        EXPECT_FALSE(is_inside_circle(points[t[0]], points[t[1]], points[t[2]], points[v])) << "trial " << trial;
  }
}

TEST(PolygonFill, of_star_shaped_polygons_covers_them_once) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 200; ++trial) {
    const std::size_t n = 4 + trial % 9;
    std::vector<Vec3> points;
    double expected = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(n),
                   r = 1 + static_cast<double>(random() % 9);
      points.push_back({r * std::cos(angle), r * std::sin(angle), 0});
    }
    for (std::size_t i = 0; i < n; ++i) expected += cross(points[i], points[(i + 1) % n]).z / 2;
    const auto fill = fill_polygon(points, around(n));
    ASSERT_TRUE(fill) << "trial " << trial;
    EXPECT_EQ(fill->size(), n - 2);
    EXPECT_NEAR(area(points, *fill), expected, 1e-9);
    for (const Triangle& t : *fill) EXPECT_GT(area(points, {t}), 0);
  }
}

TEST(PolygonFill, leaves_taken_diagonals_alone) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, -0.2, 0}, {2, 0, 0}, {1, 3, 0}};
  std::vector<char> taken(16, 0);
  taken[1 * 4 + 3] = taken[3 * 4 + 1] = 1;
  const auto fill = fill_polygon(points, around(4), taken);
  ASSERT_TRUE(fill);
  for (const Triangle& t : *fill)
    EXPECT_TRUE(std::count(t.begin(), t.end(), 0u) + std::count(t.begin(), t.end(), 2u) == 2);
  taken.assign(16, 1);
  EXPECT_FALSE(fill_polygon(points, around(4), taken));
}

TEST(QuadFill, passes_through_the_node_or_takes_the_shortest_as_asked) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, -0.5, 0}, {5, 0, 0}, {1, 0.5, 0}};
  const Vec3 node{3, 0, 0};
  const auto through = fill_quad(points, around(4), node, QuadDiagonal::through_node);
  const auto shortest = fill_quad(points, around(4), node, QuadDiagonal::shortest);
  ASSERT_TRUE(through && shortest);
  EXPECT_EQ((*through)[0], (Triangle{0, 1, 2}));
  EXPECT_EQ((*shortest)[0], (Triangle{1, 2, 3}));
}

TEST(QuadFill, takes_the_other_diagonal_when_the_wanted_one_turns_a_triangle_over) {
  const std::vector<Vec3> points{{0, 0, 0}, {2, -2, 0}, {4, 0, 0}, {2, -1, 0}};  // reflex at 3
  const auto fill = fill_quad(points, around(4), {2, -0.1, 0}, QuadDiagonal::through_node);
  ASSERT_TRUE(fill);
  EXPECT_EQ((*fill)[0], (Triangle{1, 2, 3}));
}

}  // namespace
}  // namespace strataflow
