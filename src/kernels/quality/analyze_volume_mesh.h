#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "kernels/quality/dihedral_quantiles.h"
#include "kernels/quality/distribution.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// The cells of one region.
struct RegionQuality {
  std::int32_t region = -1;  ///< the mesh's own number
  std::string name;          ///< empty when the mesh names none
  std::uint64_t cells = 0;
  double volume_m3 = 0;
  template <class A>
  void archive(A& a) {
    a(region, name, cells, volume_m3);
  }
};

/// Quality and validity of a mesh of tetrahedra, pyramids, prisms and hexahedra, from the mesh alone. Extremes and
/// means are 0 for a mesh without cells.
struct VolumeQualityReport {
  std::uint64_t vertices = 0;
  std::uint64_t cells = 0;
  std::uint64_t tetrahedra = 0, pyramids = 0, prisms = 0, hexahedra = 0;
  double volume_m3 = 0;
  std::vector<RegionQuality> per_region;  ///< ascending by number; empty when the mesh has no regions

  std::uint64_t inverted = 0;                    ///< cells with a corner determinant ≤ 0, exact
  std::vector<std::uint32_t> inverted_examples;  ///< the first few
  std::uint64_t inner_faces = 0;
  std::uint64_t boundary_faces = 0;
  std::uint64_t nonconforming_faces = 0;           ///< those of FaceMatching, and the next count
  std::uint64_t faces_with_hanging_vertex = 0;     ///< boundary faces with a vertex of others inside (T-junctions)
  std::uint64_t coincident_boundary_vertices = 0;  ///< seams that are not welded, or split on purpose; no violation
  std::uint64_t open_boundary_edges = 0;           ///< edges where the boundary faces do not close up
  double min_dihedral_deg = 0, max_dihedral_deg = 0;
  DihedralQuantiles dihedral_quantiles;
  double min_scaled_jacobian = 0, mean_scaled_jacobian = 0;
  /// In this order: dihedral_deg, scaled_jacobian, tetrahedron_radius_ratio, tetrahedron_shape, prism_shape,
  /// hexahedron_shape, hexahedron_skew, tetrahedron_relative_size, hexahedron_relative_size (relative to the mean of
  /// the type); only measures that some cell has.
  std::vector<Distribution> distributions;

  /// No inverted cell, every face between two cells the same for both, a closed boundary.
  bool is_valid() const { return inverted == 0 && nonconforming_faces == 0 && open_boundary_edges == 0; }

  template <class A>
  void archive(A& a) {
    a(vertices, cells, tetrahedra, pyramids, prisms, hexahedra, volume_m3, per_region, inverted, inverted_examples,
      inner_faces, boundary_faces, nonconforming_faces, faces_with_hanging_vertex, coincident_boundary_vertices,
      open_boundary_edges, min_dihedral_deg, max_dihedral_deg, dihedral_quantiles, min_scaled_jacobian, mean_scaled_jacobian,
      distributions);
  }
};

/// Measures every cell and matches every face. Needs consistent offsets and indices in range.
VolumeQualityReport analyze_volume_mesh(const VolumeMesh& mesh);

}  // namespace strataflow
