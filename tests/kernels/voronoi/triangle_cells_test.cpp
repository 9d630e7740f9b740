#include "kernels/voronoi/triangle_cells.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "kernels/voronoi/diagram_samples.h"

namespace strataflow {
namespace {

/// The owner by comparing all, the larger id among the equally near: the order in which sites are enlarged.
std::uint32_t nearest_of_all(const std::vector<Vec3>& sites, const Vec3& x) {
  std::uint32_t best = 0;
  for (std::uint32_t i = 1; i < sites.size(); ++i)
    if (dot(sites[i] - x, sites[i] - x) <= dot(sites[best] - x, sites[best] - x)) best = i;
  return best;
}

TEST(FindNearestSite, walks_to_the_nearest_from_any_start) {
  const auto sites = sample::random_sites(500, 5, {0, 0, 0}, {1, 1, 1});
  SiteNeighbours neighbours;
  neighbours.move_to(sites);
  const auto queries = sample::random_sites(200, 6, {-1, -1, -1}, {2, 2, 2});
  for (std::uint32_t i = 0; i < queries.size(); ++i)
    EXPECT_EQ(find_nearest_site(neighbours, queries[i], (i * 37) % 500), nearest_of_all(sites, queries[i]));
}

TEST(FindNearestSite, gives_the_larger_id_where_eight_are_equally_near) {
  std::vector<Vec3> sites;
  for (int i = 0; i < 8; ++i) sites.push_back({double(i & 1), double((i >> 1) & 1), double(i >> 2)});
  SiteNeighbours neighbours;
  neighbours.move_to(sites);
  for (std::uint32_t start = 0; start < 8; ++start)
    EXPECT_EQ(find_nearest_site(neighbours, {0.5, 0.5, 0.5}, start), 7u);
}

TEST(TriangleCells, pieces_tile_the_triangle_and_hold_what_is_nearest) {
  const auto sites = sample::random_sites(400, 7, {0, 0, -0.2}, {1, 1, 0.2});
  SiteNeighbours neighbours;
  neighbours.move_to(sites);
  TriangleCells cells(neighbours);
  const auto corners = sample::random_sites(90, 8, {-0.2, -0.2, -0.3}, {1.2, 1.2, 0.3});
  for (std::size_t i = 0; i + 3 <= corners.size(); i += 3) {
    const std::array<Vec3, 3> triangle{corners[i], corners[i + 1], corners[i + 2]};
    cells.cut(triangle, find_nearest_site(neighbours, triangle[0], 0));
    double area = 0;
    for (std::size_t k = 0; k < cells.piece_count(); ++k) {
      const TrianglePiece piece = cells.piece(k);
      area += sample::polygon_area(piece.points);
      Vec3 middle;
      for (const Vec3& p : piece.points) middle = middle + (1.0 / double(piece.points.size())) * p;
      EXPECT_EQ(piece.site, nearest_of_all(sites, middle));
    }
    EXPECT_NEAR(area, 0.5 * length(cross(triangle[1] - triangle[0], triangle[2] - triangle[0])), 1e-12);
  }
}

TEST(TriangleCells, a_small_triangle_inside_a_cell_is_one_piece) {
  SiteNeighbours neighbours;
  neighbours.move_to({{0, 0, 0}, {10, 0, 0}, {0, 10, 0}});
  TriangleCells cells(neighbours);
  cells.cut({Vec3{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, 0);
  ASSERT_EQ(cells.piece_count(), 1u);
  EXPECT_EQ(cells.piece(0).points.size(), 3u);
  for (const PieceEdge& edge : cells.piece(0).edges) EXPECT_TRUE(edge.is_triangle_edge());
}

TEST(TriangleCells, every_bisector_edge_is_shared_by_the_two_pieces_bit_for_bit) {
  // Sites on a grid, a triangle in the grid's plane through many points equally near to four of them.
  std::vector<Vec3> sites;
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 6; ++i) sites.push_back({double(i), double(j), 0});
  SiteNeighbours neighbours;
  neighbours.move_to(sites);
  TriangleCells cells(neighbours);
  cells.cut({Vec3{-0.5, -0.5, 0}, {5.5, -0.5, 0}, {5.5, 5.5, 0}}, find_nearest_site(neighbours, {-0.5, -0.5, 0}, 0));
  struct Ends {
    Vec3 from, to;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Ends> edges;
  for (std::size_t k = 0; k < cells.piece_count(); ++k) {
    const TrianglePiece piece = cells.piece(k);
    for (std::size_t i = 0; i < piece.points.size(); ++i)
      if (!piece.edges[i].is_triangle_edge())
        edges[{piece.site, piece.edges[i].site()}] = {piece.points[i], piece.points[(i + 1) % piece.points.size()]};
  }
  EXPECT_FALSE(edges.empty());
  for (const auto& [pair, ends] : edges) {
    const auto other = edges.find({pair.second, pair.first});
    ASSERT_NE(other, edges.end()) << pair.first << " borders " << pair.second << " but not the other way";
    EXPECT_EQ(ends.from, other->second.to);
    EXPECT_EQ(ends.to, other->second.from);
  }
}

TEST(TriangleCells, sites_at_one_place_leave_the_cell_to_the_last) {
  std::vector<Vec3> sites(30, Vec3{0, 0, 0});
  sites.push_back({4, 0, 0});
  SiteNeighbours neighbours;
  neighbours.move_to(sites);
  TriangleCells cells(neighbours);
  const std::array<Vec3, 3> triangle{Vec3{0, 0, 0}, {4, 0, 0}, {0, 1, 0}};
  cells.cut(triangle, find_nearest_site(neighbours, triangle[0], 3));
  std::set<std::uint32_t> owners;
  for (std::size_t k = 0; k < cells.piece_count(); ++k) owners.insert(cells.piece(k).site);
  EXPECT_EQ(owners, (std::set<std::uint32_t>{29, 30}));
}

}  // namespace
}  // namespace strataflow
