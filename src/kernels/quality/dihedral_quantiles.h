#pragma once
#include <cstdint>
#include <vector>

#include "model/volume_mesh.h"

namespace strataflow {

struct AngleQuantile {
  double share = 0;  ///< of all angles, that are this small or smaller
  double angle_deg = 0;
  template <class A>
  void archive(A& a) {
    a(share, angle_deg);
  }
};

/// How small dihedral angles are. Where two surfaces of the model meet at less than 20°, no mesh has larger angles: the
/// tetrahedra in such a wedge (those around its edge between the two surfaces) are counted apart.
struct DihedralQuantiles {
  static constexpr double wedge_deg = 20;
  std::vector<AngleQuantile> all;  ///< of 0.01, 0.1, 1, 5 and 50 %, nearest rank; empty for an empty mesh
  std::uint64_t cells_in_wedges = 0;
  double sharpest_wedge_deg = 0;      ///< 0: there is none
  double min_outside_wedges_deg = 0;  ///< smallest angle of the other cells; 0: there are none
  std::vector<AngleQuantile> outside_wedges;
  template <class A>
  void archive(A& a) {
    a(all, cells_in_wedges, sharpest_wedge_deg, min_outside_wedges_deg, outside_wedges);
  }
};

/// Measures the dihedral angles of all cells. Wedges are found from the mesh's facets, between tetrahedra; a mesh
/// without facets has none.
DihedralQuantiles dihedral_quantiles(const VolumeMesh& mesh);

}  // namespace strataflow
