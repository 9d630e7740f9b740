#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "kernels/hybrid/thin_cell.h"

namespace strataflow {

/// What a Voronoi vertex looks like from the surfaces: four sites, the one or two points of each one's cell there, and
/// for each of the four Voronoi edges at the vertex (the triple of sites without site t) which points the three
/// facets around it link. pellerin2014 §2.11.5.
struct VertexNeighbourhood {
  /// Per site: its points; no_index for the second of a site with one.
  std::array<std::array<std::uint32_t, 2>, 4> points{};
  /// links[t][i][j], i ≠ j: the point of site i linked to one of site j in triple t (t, i, j different). no_index where
  /// the facet meets no surface and site i has two points: ill-defined.
  std::array<std::array<std::array<std::uint32_t, 4>, 4>, 4> links{};

  /// All of site i's links to its point `which`, in every triple.
  static VertexNeighbourhood with_points(const std::array<std::array<std::uint32_t, 2>, 4>& points);
};

/// What a cell dual to a Voronoi vertex is, before anything is mended (§2.11.6).
enum class VertexCellKind : std::uint8_t {
  tetrahedron,
  pyramid,
  prism,
  to_subdivide,  ///< 7 or 8 vertices
  ill_defined,   ///< a facet has an edge that nothing decides
  invalid,       ///< no polyhedron has these numbers, or an edge is a diagonal, or two facets share three points
  other          ///< a polyhedron of 5 or 6 vertices, none of the above
};

struct VertexCell {
  std::vector<std::vector<std::uint32_t>> facets;   ///< cycles, all turning outward or all inward
  std::vector<std::array<std::uint32_t, 2>> edges;  ///< ascending, each once
  std::uint32_t vertex_count = 0, two_point_cells = 0, doubled_facets = 0;
  VertexCellKind kind = VertexCellKind::other;
};

/// Decides every ill-defined link so that the smallest angle of the facets with it becomes largest, one after the
/// other. Returns how many there were.
std::uint32_t decide_links(VertexNeighbourhood& around, const std::vector<Vec3>& points);

/// Builds and classifies the cell. The counting law V = 4 + c2, E = 6 + c2 + d, F = 4 + d (§2.11.5) holds for every one
/// built, and is asserted.
VertexCell build_vertex_cell(const VertexNeighbourhood& around);

/// Splits quadrilaterals that share three points with another facet along the diagonal they have in common with it, and
/// takes away the triangle that both then have (§2.11.6 (3)): the number of triangles taken away, which the cells
/// beside share directly.
std::uint32_t split_shared_facets(VertexCell& cell);

/// The cell itself where it is a tetrahedron, pyramid or prism, else the tetrahedra and pyramids from `middle` to its
/// facets, larger ones as fans (§2.11.6 (1)); nothing where one is not sound.
std::optional<std::vector<ThinCell>> cells_of(const VertexCell& cell, std::uint32_t middle,
                                              const std::vector<Vec3>& points);

}  // namespace strataflow
