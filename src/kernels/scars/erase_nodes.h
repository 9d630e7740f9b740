#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "kernels/scars/polygon_fill.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// Which of several nodes goes first.
enum class ErasureOrder : std::uint8_t {
  valence_priority,  ///< always the one with the fewest triangles, then the lowest number: few real triangulations
  as_given           ///< arbitrary: kept to reproduce the figures of the thesis
};

/// Why a node stays in the mesh.
enum class ErasureRefusal : std::uint8_t {
  on_border,      ///< its star is not a closed fan of one patch (rule R2)
  shared_place,   ///< other triangles use its position: removing it here would open a leak (rule R2)
  crossing_fill,  ///< the polygon around it does not project on its plane without crossing itself
  repeated_edge,  ///< every filling repeats an edge or a triangle that exists
  original_node   ///< it was there before the cut
};

struct RefusedErasure {
  std::uint32_t node = 0;
  ErasureRefusal reason = ErasureRefusal::on_border;
};

struct ErasureOptions {
  ErasureOrder order = ErasureOrder::valence_priority;
  QuadDiagonal diagonal = QuadDiagonal::through_node;
};

/// What erasing did. The triangles it was given are changed in place; dead ones are removed, order kept.
struct ErasureReport {
  std::vector<std::uint64_t> valence_count;  ///< [v]: nodes with a closed fan of v triangles at the start
  std::uint64_t direct_fills = 0;            ///< holes of three or four sides
  std::uint64_t delaunay_fills = 0;          ///< larger ones: the "Delaunay calls" of the source
  std::vector<RefusedErasure> refused;       ///< ascending by node
  std::vector<std::uint32_t> erased;         ///< in the order of removal
};

/// Deletes nodes and fills the holes (euler1999 §2.5.3, corrected diagonal rule). `original_edge`, empty or per point:
/// the two ends of the edge a node was put on, no_index where unknown; that edge is recreated where it fits.
/// `is_shared`, per point: its position is used by other points or surfaces.
ErasureReport erase_nodes(const std::vector<Vec3>& points, std::vector<Triangle>& triangles,
                          std::vector<std::uint32_t>& triangle_patch, const std::vector<std::uint32_t>& nodes,
                          const std::vector<char>& is_shared,
                          const std::vector<std::array<std::uint32_t, 2>>& original_edge,
                          const ErasureOptions& options = {});

}  // namespace strataflow
