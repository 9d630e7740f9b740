#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "model/vector3.h"

namespace strataflow {

/// What bounds a piece of a cell along one edge: an edge of the triangle, or the bisector with another site.
struct PieceEdge {
  static constexpr std::uint32_t on_triangle = 0x80000000u;
  std::uint32_t label = 0;  ///< on_triangle | k for the triangle's edge from corner k to k + 1; else the other site
  bool is_triangle_edge() const { return (label & on_triangle) != 0; }
  std::uint32_t triangle_edge() const { return label & 3u; }
  std::uint32_t site() const { return label; }
  static constexpr bool is_flat = true;
  friend constexpr bool operator==(const PieceEdge&, const PieceEdge&) = default;
};

/// The Voronoi diagram of sites restricted to a triangle mesh (pellerin2014 §1.2.2, §2.3): every triangle tiled by
/// convex pieces of cells, triangle by triangle.
struct RestrictedDiagram {
  std::vector<std::uint32_t> piece_triangle;
  std::vector<std::uint32_t> piece_site;
  std::vector<std::uint32_t> piece_begin;  ///< into points and edges; one more than pieces
  std::vector<Vec3> points;                ///< corners of pieces, in turn; equal corners are equal bit for bit
  std::vector<PieceEdge> edges;            ///< from each corner to the next

  std::size_t piece_count() const { return piece_site.size(); }
  std::span<const Vec3> piece_points(std::size_t piece) const {
    return {points.data() + piece_begin[piece], piece_begin[piece + 1] - piece_begin[piece]};
  }
  std::span<const PieceEdge> piece_edges(std::size_t piece) const {
    return {edges.data() + piece_begin[piece], piece_begin[piece + 1] - piece_begin[piece]};
  }
  template <class A>
  void archive(A& a) {
    a(piece_triangle, piece_site, piece_begin, points, edges);
  }
};

}  // namespace strataflow
