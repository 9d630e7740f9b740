#pragma once
#include <span>

#include "kernels/contacts/surface_search.h"
#include "model/vector3.h"

namespace strataflow {

/// The point nearest to p of a convex polygon: a triangle or more corners in one plane.
Vec3 nearest_on_polygon(const Vec3& p, std::span<const Vec3> polygon);

/// Squared distance of two pieces that do not cross each other: segments (2 points) or convex polygons.
double squared_distance_of_pieces(std::span<const Vec3> a, std::span<const Vec3> b);

}  // namespace strataflow
