#pragma once
#include <cstdint>
#include <vector>

#include "base/cancellation.h"
#include "kernels/volumes/region_boundary.h"
#include "kernels/volumes/region_mesh.h"

namespace strataflow {

/// How many sites a region takes inside for cells as large as its surfaces' edges say: an edge of length h goes with
/// cells of 0.7 h³ (0.64 in a body-centred lattice of that mean edge). Points of the boundary have their share of it,
/// by the angle under which they see the inside. ≥ 0.
double interior_site_count(const RegionBoundary& boundary, const RegionMesh& mesh);

/// `count` sites inside, spread as a centroidal Voronoi tessellation restricted to the region (pellerin2014 §2.11.1
/// (1)), in which the points of the boundary are sites that stay where they are. Lengths of edges at the boundary's
/// points set the density, so sites crowd where surfaces are fine: Lloyd's steps alone. `mesh` fills the region and
/// has few points inside. Cancelled: what there is so far.
std::vector<Vec3> spread_interior_sites(const RegionBoundary& boundary, const RegionMesh& mesh, std::size_t count,
                                        std::size_t lloyd_iterations, const CancellationToken* cancellation = nullptr);

}  // namespace strataflow
