#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

/// `count` points on the triangles, as evenly as chance allows: the total of density · area is cut into `count` equal
/// shares in the order of triangles, and one point is drawn in each (pellerin2014 Alg 4.1; stratified sampling).
/// `density` is per point, or empty for 1. Empty if the area is 0.
std::vector<Vec3> sample_sites(std::span<const Vec3> points, std::span<const Triangle> triangles,
                               std::span<const double> density, std::size_t count, std::uint64_t seed);

}  // namespace strataflow
