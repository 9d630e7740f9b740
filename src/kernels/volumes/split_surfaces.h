#pragma once
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "kernels/volumes/region_attempt.h"
#include "kernels/volumes/region_boundary.h"
#include "kernels/volumes/region_mesh.h"

namespace strataflow {

/// Points to insert on an edge of the surfaces, from its first to its second point; first < second.
struct SplitEdge {
  std::uint32_t first = 0;
  std::uint32_t second = 0;
  std::vector<std::uint32_t> inserted;
};

/// How one region's mesh splits the triangles around it. Points are indices into SurfaceTriangles once `points` are
/// appended there.
struct SurfaceSplit {
  std::vector<Vec3> points;
  std::vector<SplitEdge> edges;                     ///< by first, then second
  std::vector<std::vector<Triangle>> facet_pieces;  ///< per facet of the boundary, oriented like it
  std::vector<Tet> tets;                            ///< in the numbers of `tet_points`
  std::vector<Vec3> tet_points;                     ///< the split boundary's points, then interior ones
};

/// Reads from `answer`, a mesh of `boundary` with points on facets and edges, what happened to each facet. Rejects
/// an answer in which the pieces of a facet are not a disk with its three corners, or two facets disagree on an edge.
std::variant<SurfaceSplit, Rejection> surface_split(const RegionBoundary& boundary, const SurfaceTriangles& surfaces,
                                                    const RegionAnswer& answer);

/// `surfaces` after the split: facets of `boundary` replaced by their pieces, every other triangle around a split
/// edge divided at the same points, line segments divided too. `changed`: per triangle of `surfaces`, 1 if it was.
SurfaceTriangles with_split(const SurfaceTriangles& surfaces, const RegionBoundary& boundary, const SurfaceSplit& split,
                            std::vector<std::uint8_t>& changed);

}  // namespace strataflow
