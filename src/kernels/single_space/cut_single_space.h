#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "model/triangle_soup.h"

namespace strataflow {

struct SingleSpaceOptions {
  /// [0, 0.5): where the trace passes a vertex nearer than this share of the triangle's shortest side, that vertex
  /// moves onto the trace instead of a new node being inserted. The source gives no value.
  double close_ratio = 0.25;
};

struct SingleSpaceReport {
  std::uint64_t crossed_triangles = 0;
  std::uint64_t moved_vertices = 0;  ///< elected vertices
  std::uint64_t inserted_nodes = 0;  ///< one per other crossed triangle, and one per border edge crossed
  std::uint64_t flipped_edges = 0;
  std::uint64_t split_edges = 0;  ///< crossed edges whose diagonal could not be flipped: a node stands on them
  std::uint64_t doubled_nodes = 0;
  /// Crossed triangles left alone: crossed several times on a side, or by the rim of the cutting surface.
  std::vector<std::uint32_t> skipped_triangles;  ///< of the input, ascending
};

struct SingleSpaceCut {
  TriangleSoup soup;                                ///< the cut entity split along the trace; all else as it was
  std::vector<std::array<std::uint32_t, 2>> trace;  ///< its edges, ascending, as points before they were doubled
  SingleSpaceReport report;
};

/// Cuts entity `cut` by entity `cutting` with few nodes and without retriangulating (euler1999 §2.7): vertices near the
/// trace move onto it, every other crossed triangle gets one node, which moves along its median onto the cutting
/// surface; diagonals are flipped until the nodes are joined, and the surface is split along them. Which edges are
/// crossed and which flips are upright is decided exactly. The two surfaces are not made to conform: for surface
/// modelling only, not for models that are to be filled with cells.
/// Fails with invalid_options; invalid_input when an entity has no triangle.
Result<SingleSpaceCut> cut_single_space(const TriangleSoup& soup, std::uint32_t cut, std::uint32_t cutting,
                                        const SingleSpaceOptions& options = {});

}  // namespace strataflow
