#pragma once
#include <cstdint>
#include <vector>

#include "kernels/volumes/region_boundary.h"
#include "kernels/volumes/region_mesh.h"

namespace strataflow {

/// The vertices of Voronoi diagrams inside regions, and their dual cells that are no cells of the mesh (pellerin2014 §3
/// rule H7).
struct VertexDualCounts {
  std::uint64_t vertices = 0;                               ///< of the diagram of a region's points, wherever they lie
  std::uint64_t candidates = 0;                             ///< coloured with the region
  std::uint64_t unreached = 0;                              ///< that no edge tells the region of
  std::uint64_t edges = 0;                                  ///< of the diagram
  std::uint64_t checked_edges = 0, inconsistent_edges = 0;  ///< not needed for the colouring: it agrees, or not
  // Before anything is mended: what became of the candidates.
  std::uint64_t flat = 0;      ///< with a scaled Jacobian below 1e-3
  std::uint64_t crossing = 0;  ///< a triangle of the surfaces goes through the cell, or an edge through a face of it
  std::uint64_t replaced = 0;  ///< sound and inside, but the fill has other cells there
  std::uint64_t kept = 0;      ///< cells of the mesh
  template <class A>
  void archive(A& a) {
    a(vertices, candidates, unreached, edges, checked_edges, inconsistent_edges, flat, crossing, replaced, kept);
  }
};

/// Which cells of a mesh are duals of Voronoi vertices.
struct VertexDuals {
  std::vector<char> is_dual;  ///< per tetrahedron of the mesh
  VertexDualCounts counts;
};

/// Holds a region's tetrahedra against the Voronoi diagram of its points, restricted to it (pellerin2014 §2.11.3 and
/// 2.11.5): the diagram's vertices and edges are coloured by where the edges pierce `boundary`; a vertex coloured as
/// inside has the four sites nearest to it for a cell, which is a tetrahedron by the counting law, since each has one
/// point. A tetrahedron of `mesh` is a dual when it is such a cell.
VertexDuals find_vertex_duals(const RegionBoundary& boundary, const RegionMesh& mesh);

}  // namespace strataflow
