#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "kernels/volumes/region_boundary.h"

namespace strataflow {

using Tet = std::array<std::uint32_t, 4>;

/// The tetrahedra of one region. Vertices below boundary.points.size() are the boundary's, the rest interior points.
struct RegionMesh {
  std::vector<Vec3> interior_points;
  std::vector<Tet> tets;
  /// Per facet of the boundary: the tetrahedron on its negative and on its positive side, no_index where the region
  /// is not on that side.
  std::vector<std::array<std::uint32_t, 2>> facet_tets;
};

/// Coordinates by vertex: the boundary's, then the interior points.
std::vector<Vec3> points_of(const RegionBoundary& boundary, const RegionMesh& mesh);

/// m³, positive for the orientation of VolumeMesh.
double volume_of(const std::vector<Vec3>& points, const Tet& tet);

/// Why a mesh was not taken, in words.
struct Rejection {
  std::string reason;
};

/// Keeps of `tets`, which fill at least everything the boundary encloses, those inside the region: the side of a
/// facet says inside or outside, and faces that are no facet pass it on. Then verifies what is left: every facet is a
/// face, two tetrahedra at most meet in a face and on opposite sides of it, every tetrahedron is positively oriented
/// (exactly), and the volumes add up to `volume_m3` to 1e-9. `points`: the boundary's coordinates, then the others.
std::variant<RegionMesh, Rejection> verified_region_mesh(const RegionBoundary& boundary,
                                                         const std::vector<Vec3>& points, const std::vector<Tet>& tets,
                                                         double volume_m3);

}  // namespace strataflow
