#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

/// The undirected edges of triangles and who uses them. A half-edge h = 3·triangle + k runs from corner k of the
/// triangle to corner (k + 1) mod 3.
struct EdgeTable {
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< vertices, ascending inside and between edges
  std::vector<std::uint32_t> first;                 ///< per edge, plus one: where its half-edges start
  std::vector<std::uint32_t> half_edges;            ///< ascending inside each edge
  std::vector<std::uint32_t> edge_of;               ///< per half-edge: its edge

  std::span<const std::uint32_t> around(std::uint32_t edge) const {
    return {half_edges.data() + first[edge], half_edges.data() + first[edge + 1]};
  }
  std::uint32_t edge_count() const { return static_cast<std::uint32_t>(edges.size()); }
};

/// Builds the table in linear time. Triangles have three different vertices below `point_count`.
EdgeTable build_edge_table(std::size_t point_count, const std::vector<Triangle>& triangles);

/// Whether an edge bounds surfaces: other than two triangles meet there, or their labels differ (pellerin2014 §2.1,
/// builder step 2). `label` is per triangle: its patch, or its surface.
inline bool is_feature_edge(const EdgeTable& table, std::uint32_t edge, const std::vector<std::uint32_t>& label) {
  const auto around = table.around(edge);
  return around.size() != 2 || label[around[0] / 3] != label[around[1] / 3];
}

/// The edge between two vertices, or no_index.
std::uint32_t find_edge(const EdgeTable& table, std::uint32_t a, std::uint32_t b);

}  // namespace strataflow
