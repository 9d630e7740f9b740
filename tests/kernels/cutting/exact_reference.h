#pragma once
#include <array>
#include <string>
#include <vector>

#include "kernels/cutting/cut_triangles.h"

namespace strataflow::support {

/// Arrangements computed the plain way, with all constructions in CGAL's exact kernel: slow, and sharing nothing with
/// the cutter.

using Corners = std::array<Vec3, 3>;

/// What two triangles share: its corners, correctly rounded and ascending, and its dimension (−1: nothing).
struct SharedSet {
  int dimension = -1;
  std::vector<Vec3> corners;
};
SharedSet shared_set(const Corners& a, const Corners& b);

/// They meet in more than the corners and the edge they have in common.
bool meet_improperly(const Corners& a, const Corners& b);

/// Pairs of triangles that meet improperly; every pair whose boxes meet is asked. Triangles at one place (of surfaces
/// that coincide) count as one.
std::size_t improper_pairs(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles);

/// The first thing wrong with a cut of all against all, or nothing: points are those of the exact arrangement, rounded
/// once; pieces are turned as their triangle, lie in it and fill it exactly; whatever two triangles share is made of
/// the same edges, or the same pieces, in both.
std::string flaw_of_cut(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                        const TriangleCut& cut);

}  // namespace strataflow::support
