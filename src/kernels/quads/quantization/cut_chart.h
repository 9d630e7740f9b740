#pragma once
#include <cstdint>
#include <vector>

#include "kernels/quads/quantization/flat_mesh.h"

namespace strataflow {

/// A surface cut open along a graph through all its cone points, and one chart for each of its pieces (coudert2024 S34,
/// reduction 1). Values of the map in these charts are linear forms over few variables: one per point (its value at
/// `first_corner`, variable = point) and the translation across each branch of the cut (variable = points + branch),
/// so that forms stay short however they are added.
struct CutChart {
  std::vector<std::uint8_t> turns;          ///< per triangle: i^turns turns its own chart into that of its piece
  std::vector<std::uint32_t> entered_by;    ///< per triangle: half-edge of the triangle before it, or outside
  std::vector<std::uint32_t> rank;          ///< per triangle: its place in the order of this walk
  std::vector<std::uint32_t> walk;          ///< per rank: its triangle
  std::vector<std::uint32_t> first_corner;  ///< per point
  std::vector<std::uint32_t> branch_edges;  ///< per branch: the half-edge whose translation it is
  std::vector<LinearForm> corners;          ///< per corner: its value in the chart of its piece

  /// Σ form as terms over the map's own corners: paths through the triangles that carry the chart. Exact for every map
  /// with these turns, whichever translations it has across edges, if the form does not change when all values of a
  /// piece are moved by the same vector. Terms cancel further where the caller knows values to be the same (4.4).
  std::vector<IntegerTerm> expand(const FlatMesh& flat, const LinearForm& form) const;
};

/// `flat` is what round_map made of a map.
CutChart cut_chart(const FlatMesh& flat);

}  // namespace strataflow
