#include "kernels/hybrid/region_colouring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/seed.h"

namespace strataflow {
namespace {

/// Edges as "from, to, {regions left and entered in turn}".
struct EdgeList {
  PiercedEdges graph;
  explicit EdgeList(std::uint32_t vertices) {
    graph.vertex_count = vertices;
    graph.crossing_begin = {0};
  }
  EdgeList& add(std::uint32_t a, std::uint32_t b, std::vector<EdgeCrossing> crossings = {}) {
    graph.edges.push_back({a, b});
    graph.crossings.insert(graph.crossings.end(), crossings.begin(), crossings.end());
    graph.crossing_begin.push_back(static_cast<std::uint32_t>(graph.crossings.size()));
    return *this;
  }
};

constexpr std::uint32_t far = PiercedEdges::at_infinity;

TEST(ColourRegions, labels_edges_between_two_inside_vertices_that_cross_a_notch) {  // defect (ii)
  const RegionColouring colours =
      colour_regions(EdgeList(2).add(0, 1, {{0, universe}, {universe, 0}}).add(0, far, {{0, universe}}).graph);
  EXPECT_EQ(colours.vertex_region, (std::vector<std::uint32_t>{0, 0}));
  EXPECT_EQ(colours.piece_region, (std::vector<std::uint32_t>{0, universe, 0, 0, universe}));
  EXPECT_TRUE(colours.inconsistent_edges.empty());
}

TEST(ColourRegions, knows_any_number_of_regions_and_dangling_surfaces) {  // defects (iv), (v)
  const RegionColouring colours = colour_regions(EdgeList(4)
                                                     .add(0, 1, {{7, 3}})
                                                     .add(1, 2, {{3, 3}})  // a fault that ends inside region 3
                                                     .add(2, 3)
                                                     .add(3, 0, {{3, 7}})
                                                     .graph);
  EXPECT_EQ(colours.vertex_region, (std::vector<std::uint32_t>{7, 3, 3, 3}));
  EXPECT_TRUE(colours.inconsistent_edges.empty());
}

TEST(ColourRegions, names_edges_on_which_two_ways_disagree) {
  const RegionColouring colours = colour_regions(EdgeList(3).add(0, 1, {{0, 1}}).add(1, 2).add(2, 0).add(0, far).graph);
  EXPECT_FALSE(colours.inconsistent_edges.empty());
  const RegionColouring open = colour_regions(EdgeList(3).add(0, 1).graph);
  EXPECT_EQ(open.vertex_region[0], RegionColouring::unreached);  // nothing tells
}

/// X1 (Fig 5.2): the Voronoi diagram of sites in a square, by brute force: every circle through three of them that
/// holds no other is a vertex.
struct Diagram {
  std::vector<Vec3> vertices;
  std::vector<std::array<std::size_t, 3>> owners;
};

Diagram voronoi_of(const std::vector<Vec3>& sites) {
  Diagram diagram;
  for (std::size_t a = 0; a < sites.size(); ++a)
    for (std::size_t b = a + 1; b < sites.size(); ++b)
      for (std::size_t c = b + 1; c < sites.size(); ++c) {
        const Vec3 u = sites[b] - sites[a], v = sites[c] - sites[a];
        const double twice = 2 * (u.x * v.y - u.y * v.x);
        const Vec3 centre = sites[a] + Vec3{(v.y * dot(u, u) - u.y * dot(v, v)) / twice,
                                            (u.x * dot(v, v) - v.x * dot(u, u)) / twice, 0};
        const double radius = length(centre - sites[a]);
        if (std::any_of(sites.begin(), sites.end(), [&](const Vec3& s) { return length(s - centre) < radius - 1e-9; }))
          continue;
        diagram.vertices.push_back(centre);
        diagram.owners.push_back({a, b, c});
      }
  return diagram;
}

TEST(ColourRegions, finds_the_inside_of_a_star) {  // X1
  RandomStream random(5);
  std::vector<Vec3> sites;
  for (int i = 0; i < 21; ++i) sites.push_back({random.unit(), random.unit(), 0});
  std::vector<Vec3> star;
  for (int i = 0; i < 10; ++i) {
    const double angle = i * std::numbers::pi / 5, radius = i % 2 ? 0.17 : 0.45;
    star.push_back({0.5 + radius * std::sin(angle), 0.5 + radius * std::cos(angle), 0});
  }
  const auto is_inside = [&](const Vec3& p) {
    bool inside = false;
    for (std::size_t i = 0; i < star.size(); ++i) {
      const Vec3 &a = star[i], &b = star[(i + 1) % star.size()];
      if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)) inside = !inside;
    }
    return inside;
  };
  const Diagram diagram = voronoi_of(sites);
  std::map<std::array<std::size_t, 2>, std::vector<std::uint32_t>> by_sites;
  for (std::uint32_t v = 0; v < diagram.owners.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<std::size_t, 2> pair{diagram.owners[v][k], diagram.owners[v][(k + 1) % 3]};
      std::sort(pair.begin(), pair.end());
      by_sites[pair].push_back(v);
    }
  EdgeList edges(static_cast<std::uint32_t>(diagram.vertices.size()));
  std::vector<std::array<Vec3, 2>> ends;
  std::size_t infinite = 0, infinite_outside = 0;
  for (const auto& [pair, vertices] : by_sites) {
    const Vec3 from = diagram.vertices[vertices[0]];
    Vec3 to;
    if (vertices.size() == 2) {
      to = diagram.vertices[vertices[1]];
    } else {  // away from the third site
      const std::size_t third = diagram.owners[vertices[0]][0] + diagram.owners[vertices[0]][1] +
                                diagram.owners[vertices[0]][2] - pair[0] - pair[1];
      const Vec3 along = sites[pair[1]] - sites[pair[0]], middle = 0.5 * (sites[pair[0]] + sites[pair[1]]);
      Vec3 away{along.y, -along.x, 0};
      if (dot(away, sites[third] - middle) > 0) away = -1.0 * away;
      to = from + (10 / length(away)) * away;
      ++infinite;
    }
    std::vector<double> hits;
    for (std::size_t i = 0; i < star.size(); ++i) {
      const Vec3 d = to - from, e = star[(i + 1) % star.size()] - star[i], w = star[i] - from;
      const double det = d.x * e.y - d.y * e.x, t = (w.x * e.y - w.y * e.x) / det, s = (w.x * d.y - w.y * d.x) / det;
      if (t > 0 && t < 1 && s >= 0 && s < 1) hits.push_back(t);
    }
    std::sort(hits.begin(), hits.end());
    std::vector<EdgeCrossing> crossings;
    for (const double t : hits) {
      const bool enters = is_inside(from + (t + 1e-7) * (to - from));
      crossings.push_back(enters ? EdgeCrossing{universe, 0} : EdgeCrossing{0, universe});
    }
    infinite_outside += vertices.size() == 1 && hits.empty();
    edges.add(vertices[0], vertices.size() == 2 ? vertices[1] : far, crossings);
    ends.push_back({from, to});
  }
  ASSERT_GE(infinite, 5u);
  ASSERT_GE(infinite_outside, 3u);
  const RegionColouring colours = colour_regions(edges.graph);
  EXPECT_TRUE(colours.inconsistent_edges.empty());
  EXPECT_GT(colours.checked_edges, 5u);
  std::size_t inside = 0;
  for (std::size_t v = 0; v < diagram.vertices.size(); ++v) {
    EXPECT_EQ(colours.vertex_region[v], is_inside(diagram.vertices[v]) ? 0 : universe) << v;
    inside += colours.vertex_region[v] == 0;
  }
  EXPECT_GT(inside, 3u);
  for (std::size_t e = 0; e < ends.size(); ++e) {
    const std::uint32_t first = edges.graph.crossing_begin[e], count = edges.graph.crossing_begin[e + 1] - first;
    if (count == 0) {
      const Vec3 middle = 0.5 * (ends[e][0] + ends[e][1]);
      EXPECT_EQ(colours.piece_region[first + e], is_inside(middle) ? 0 : universe) << e;
    }
  }
}

}  // namespace
}  // namespace strataflow
