#pragma once
#include <cstdint>
#include <vector>

#include "model/triangle_soup.h"

namespace strataflow {

/// Moves each of `nodes` to Σ barycentre · area / Σ area over its triangles (euler1999 §2.9.4): one Jacobi pass, all
/// targets from the old positions. A move that would turn a triangle over or flatten it is given up, and so is one on a
/// crease, where the triangles around differ in direction by more than `corner_angle_deg` from their mean. The nodes
/// must lie on no border. Returns those moved, ascending.
std::vector<std::uint32_t> relax_ring(std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                                      const std::vector<std::uint32_t>& nodes, double corner_angle_deg);

}  // namespace strataflow
