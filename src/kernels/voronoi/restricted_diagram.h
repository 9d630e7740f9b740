#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/voronoi/site_neighbours.h"
#include "model/restricted_diagram.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// Per point of a mesh the nearest site. `owners` holds guesses (the last answer, if sites moved a little); others
/// than one site for each point are none.
void find_owners(std::span<const Vec3> points, const SiteNeighbours& neighbours, std::vector<std::uint32_t>& owners);

/// Needs at least one site. No neighbour triangles are walked: triangles are independent, and cut in parallel.
RestrictedDiagram restrict_to_triangles(std::span<const Vec3> points, std::span<const Triangle> triangles,
                                        const SiteNeighbours& neighbours);

}  // namespace strataflow
