#include "kernels/cutting/constrained_triangulation.h"

#include <gtest/gtest.h>

#include <set>

#include "base/seed.h"

namespace strataflow {
namespace {

using Segments = std::vector<std::array<std::uint32_t, 2>>;

/// Vertices in the plane z = 0; the first three are the corners.
struct Plane {
  explicit Plane(std::vector<Vec3> vertices, const std::vector<PlaceInTriangle>& places = {})
      : input(std::move(vertices)), points(input) {
    points.restart({0, 1, 2});
    for (std::uint32_t i = 3; i < input.size(); ++i)
      points.add(vertex_point(i), input[i], places.empty() ? place_inside : places[i - 3]);
  }
  std::vector<Vec3> input;
  PointsInTriangle points;
  ConstrainedTriangulation triangulation;
};

/// Every cell turns right, cells fill the triangle, neighbours know each other; returns the edges.
std::set<std::array<std::uint32_t, 2>> checked_edges(const Plane& plane) {
  std::set<std::array<std::uint32_t, 2>> edges;
  double area = 0;
  const auto& cells = plane.triangulation.cells();
  for (std::uint32_t c = 0; c < cells.size(); ++c) {
    const auto& v = cells[c].vertices;
    EXPECT_EQ(plane.points.orientation(v[0], v[1], v[2]), 1);
    area += 0.5 * cross(plane.input[v[1]] - plane.input[v[0]], plane.input[v[2]] - plane.input[v[0]]).z;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = v[k], b = v[(k + 1) % 3];
      edges.insert({std::min(a, b), std::max(a, b)});
      const std::uint32_t other = cells[c].neighbours[k];
      if (other == no_index) {
        EXPECT_TRUE(cells[c].is_fixed[k]) << "edges of the triangle are fixed";
        continue;
      }
      const auto& w = cells[other];
      bool is_mutual = false;
      for (int m = 0; m < 3; ++m)
        if (w.vertices[m] == b && w.vertices[(m + 1) % 3] == a)
          is_mutual = w.neighbours[m] == c && w.is_fixed[m] == cells[c].is_fixed[k];
      EXPECT_TRUE(is_mutual);
    }
  }
  EXPECT_NEAR(area, 0.5 * cross(plane.input[1] - plane.input[0], plane.input[2] - plane.input[0]).z, 1e-9);
  return edges;
}

TEST(ConstrainedTriangulation, of_nothing_is_the_triangle) {
  Plane plane({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}});
  ASSERT_TRUE(plane.triangulation.build(plane.points, {}));
  EXPECT_EQ(plane.triangulation.cells().size(), 1u);
}

TEST(ConstrainedTriangulation, splits_edges_in_order_and_joins_points_inside) {
  Plane plane({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {3, 0, 0}, {1, 0, 0}, {2, 2, 0}, {1, 1, 0}}, {3, 3, 4, place_inside});
  ASSERT_TRUE(plane.triangulation.build(plane.points, {}));
  EXPECT_EQ(plane.triangulation.cells().size(), 6u);
  const auto edges = checked_edges(plane);
  EXPECT_TRUE(edges.count({0, 4}) && edges.count({3, 4}) && edges.count({1, 3}));
}

TEST(ConstrainedTriangulation, has_its_segments_as_edges) {
  Plane plane({{0, 0, 0}, {12, 0, 0}, {0, 12, 0}, {1, 5, 0}, {7, 4, 0}, {3, 4, 0}, {3, 6, 0}, {5, 3, 0}, {5, 6, 0}});
  const Segments segments{{3, 4}, {0, 7}};
  ASSERT_TRUE(plane.triangulation.build(plane.points, segments));
  const auto edges = checked_edges(plane);
  for (const auto& s : segments) EXPECT_TRUE(edges.count(s));
}

TEST(ConstrainedTriangulation, refuses_segments_that_cross) {
  Plane plane({{0, 0, 0}, {12, 0, 0}, {0, 12, 0}, {1, 1, 0}, {4, 4, 0}, {1, 4, 0}, {4, 1, 0}});
  EXPECT_FALSE(plane.triangulation.build(plane.points, {{3, 4}, {5, 6}}));
}

TEST(ConstrainedTriangulation, is_delaunay_without_segments) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    RandomStream random(seed);
    std::vector<Vec3> vertices{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (int i = 0; i < 60; ++i) {
      const double x = random.unit(), y = random.unit();
      if (x + y < 0.99 && x > 0.01 && y > 0.01) vertices.push_back({x, y, 0});
    }
    Plane plane(vertices);
    ASSERT_TRUE(plane.triangulation.build(plane.points, {}));
    checked_edges(plane);
    for (const auto& cell : plane.triangulation.cells())
      for (std::uint32_t p = 0; p < vertices.size(); ++p)
        EXPECT_FALSE(plane.points.is_surely_in_circle(cell.vertices[0], cell.vertices[1], cell.vertices[2], p));
  }
}

TEST(ConstrainedTriangulation, holds_random_segments_on_a_grid_full_of_collinear_points) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    RandomStream random(seed);
    std::vector<Vec3> vertices{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}};
    for (int x = 1; x < 9; ++x)
      for (int y = 1; x + y < 10; ++y)
        if (random.below(3) > 0) vertices.push_back({static_cast<double>(x), static_cast<double>(y), 0});
    Plane plane(vertices);
    const auto crosses = [&](const std::array<std::uint32_t, 2>& s, const std::array<std::uint32_t, 2>& t) {
      const auto& p = plane.points;
      return p.orientation(s[0], s[1], t[0]) * p.orientation(s[0], s[1], t[1]) < 0 &&
             p.orientation(t[0], t[1], s[0]) * p.orientation(t[0], t[1], s[1]) < 0;
    };
    Segments segments;
    for (int tries = 0; tries < 40; ++tries) {
      auto a = static_cast<std::uint32_t>(random.below(vertices.size())),
           b = static_cast<std::uint32_t>(random.below(vertices.size()));
      if (a == b) continue;
      const std::array<std::uint32_t, 2> s{std::min(a, b), std::max(a, b)};
      bool is_free = !(s[1] < 3);
      for (std::uint32_t p = 0; p < vertices.size() && is_free; ++p)
        is_free = p == a || p == b || plane.points.orientation(a, b, p) != 0 || !plane.points.is_between(p, a, b);
      for (const auto& t : segments) is_free = is_free && !crosses(s, t);
      if (is_free) segments.push_back(s);
    }
    ASSERT_TRUE(plane.triangulation.build(plane.points, segments)) << "seed " << seed;
    const auto edges = checked_edges(plane);
    for (const auto& s : segments) EXPECT_TRUE(edges.count(s)) << "seed " << seed;
  }
}

}  // namespace
}  // namespace strataflow
