#pragma once
#include <cstdint>
#include <vector>

#include "model/structural_model.h"

namespace strataflow {

/// Where an edge of a Voronoi diagram pierces a surface: the regions left and entered along the edge's direction,
/// `universe` outside; equal where the surface hangs inside one region.
struct EdgeCrossing {
  std::uint32_t from_region = universe;
  std::uint32_t to_region = universe;
  static constexpr bool is_flat = true;
};

/// The edges of a Voronoi diagram and where they pierce surfaces.
struct PiercedEdges {
  static constexpr std::uint32_t at_infinity = 0xffffffffu;
  std::uint32_t vertex_count = 0;
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< first and second vertex; the second may be at infinity
  std::vector<std::uint32_t> crossing_begin;        ///< per edge, plus one
  std::vector<EdgeCrossing> crossings;              ///< edge by edge, in order from the first vertex
};

/// The region of every Voronoi vertex and of every piece of every edge.
struct RegionColouring {
  std::vector<std::uint32_t> vertex_region;  ///< `unreached` where nothing tells
  /// Edge by edge, one more than its crossings: the pieces from its first vertex on. Edge e's begin at
  /// crossing_begin[e] + e.
  std::vector<std::uint32_t> piece_region;
  std::vector<std::uint32_t> inconsistent_edges;  ///< ascending: where two ways round say different things
  std::uint64_t checked_edges = 0;                ///< not needed to reach a vertex, and consistent
  static constexpr std::uint32_t unreached = 0xfffffffeu;
};

/// Colours Voronoi vertices and edge pieces by region (pellerin2014 Alg 5.1, §2.11.3, its defects mended): labels
/// spread over all edges, infinite ones included, from every crossing and from infinity, which is outside; a crossing
/// changes the label as its surface's sides say, so dangling surfaces and any number of regions are no exception, and
/// pieces between crossings are labelled whatever their ends are. Every edge that is not needed is checked.
RegionColouring colour_regions(const PiercedEdges& edges);

}  // namespace strataflow
