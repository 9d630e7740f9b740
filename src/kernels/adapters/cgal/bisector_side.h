#pragma once
#include <cstdint>
#include <span>

#include "model/vector3.h"

namespace strataflow {

/// A site with the id that orders symbolic perturbations.
struct PerturbedSite {
  Vec3 position;
  std::uint32_t id = 0;
};

/// Exact side of a point of a Voronoi diagram restricted to a simplex. The simplex has n = corners.size() corners
/// (1: a point, 2: an edge, 3: a triangle, 4: a tetrahedron); the point is where the n − 1 bisectors of `owner` with
/// each of `bisectors` meet in it. Returns +1 if the point is nearer to `owner` than to `other`, else −1: never 0,
/// for each site's squared distance is enlarged by an infinitesimal, larger by orders for smaller ids (simulation of
/// simplicity, Edelsbrunner and Mücke 1990). Along the simplex a bisector is an affine function known by its values
/// at the corners, so the sign is that of a determinant of n² such values. The bisectors must meet in one point.
int bisector_side(std::span<const Vec3> corners, const PerturbedSite& owner, std::span<const PerturbedSite> bisectors,
                  const PerturbedSite& other);

/// Exact sign of det of the bisectors' values at the corners and a row of ones: the orientation in which they meet;
/// 0 if parallel.
int bisector_orientation(std::span<const Vec3> corners, const Vec3& owner, std::span<const PerturbedSite> bisectors);

}  // namespace strataflow
