#pragma once
#include <cstdint>
#include <vector>

#include "kernels/topology/building/edge_table.h"
#include "model/structural_model.h"

namespace strataflow {

/// The one-dimensional part of a model.
struct LineNetwork {
  std::vector<Corner> corners;  ///< ascending by vertex
  std::vector<Line> lines;
  std::vector<std::vector<std::uint32_t>> line_edges;  ///< per line: its edges, in order along it
};

/// Chains feature edges between corners (pellerin2014 §2.1 builder steps 4–5). A corner is a vertex with other than
/// two feature edges, or where the surfaces around its two edges differ. Minimal: no optional border stones.
LineNetwork build_lines(const EdgeTable& edges, const std::vector<char>& is_feature,
                        const std::vector<std::uint32_t>& surface_of, std::size_t point_count);

}  // namespace strataflow
