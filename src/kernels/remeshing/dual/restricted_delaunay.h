#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "kernels/remeshing/dual/cell_components.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// The plain dual of a restricted diagram, for comparison: its vertices are the sites, and two or more sheets in one
/// cell become one (pellerin2014 §1.2). Each list ascending and without repeats.
struct RestrictedDelaunay {
  std::vector<Triangle> triangles;                       ///< three cells meet on a surface; lowest site first,
                                                         ///< turning like the first triangle where they meet
  std::vector<std::array<std::uint32_t, 2>> edges;       ///< two cells meet on a surface
  std::vector<std::array<std::uint32_t, 2>> line_edges;  ///< two cells meet on a line: the outlines' own dual
};

RestrictedDelaunay restricted_delaunay(const RestrictedDiagram& diagram, const CellComponents& components);

}  // namespace strataflow
