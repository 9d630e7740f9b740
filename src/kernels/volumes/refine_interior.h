#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/cancellation.h"
#include "kernels/volumes/region_boundary.h"
#include "kernels/volumes/region_mesh.h"

namespace strataflow {

/// What the tetrahedra inside a region should be like.
struct InteriorGoal {
  std::optional<double> max_volume_m3;      ///< > 0; always reached
  std::optional<double> radius_edge_ratio;  ///< ≥ 1.1; reached except beside surfaces, which are kept
  bool is_empty() const { return !max_volume_m3 && !radius_edge_ratio; }
};

/// Inserts interior points, one at a time, until the goal is met: the circumcentre of a bad tetrahedron where it can be
/// seen from it inside the region, else (volume only) its centroid. Each point takes the place of the tetrahedra around
/// it whose circumsphere holds it, no further than facets and only as far as it sees them (exact orientations), so
/// every step keeps a valid mesh with the same surfaces. Deterministic: bad tetrahedra are treated in the order in
/// which they arise. Stops early, with a valid mesh short of its goal, when `cancellation` asks for it.
void refine_interior(const RegionBoundary& boundary, RegionMesh& mesh, const InteriorGoal& goal,
                     const CancellationToken* cancellation = nullptr);

/// Inserts `points` the same way, one after the other, but those that no tetrahedron holds or sees all around: the
/// result is as near to a constrained Delaunay triangulation as the mesh was. Returns the places of those inserted,
/// ascending; in this order they follow the interior points so far.
std::vector<std::uint32_t> insert_interior_points(const RegionBoundary& boundary, RegionMesh& mesh,
                                                  std::span<const Vec3> points);

}  // namespace strataflow
