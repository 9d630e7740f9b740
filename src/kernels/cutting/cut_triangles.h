#pragma once
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "kernels/intersection/find_intersections.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// Triangles cut along everything they share. Input points keep their indices; new ones follow: points of pairs of
/// triangles in lexicographic order, then points of three.
struct TriangleCut {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> source;     ///< per triangle: the input triangle it is, or is a piece of
  std::vector<char> is_piece;            ///< per triangle: a piece of a triangle that was cut
  std::uint64_t cut_triangle_count = 0;  ///< input triangles that were cut
  std::uint64_t collapsed_count = 0;     ///< pieces that rounding made flat and that were dropped
};

/// Cuts each triangle of `pairs` along the other one (euler1999 §2.3 and §2.6 with every degenerate case): points of
/// intersection stay implicit and are compared exactly, then rounded once to the nearest doubles. Pieces of different
/// triangles share vertices by index, and where triangles overlap in one plane the pieces are the same, corner by
/// corner. `may_be_cut`, per triangle, leaves triangles as they are; empty: all may. New points are rounded to what
/// survives being moved by `origin`. Points are welded; no triangle of a pair has zero area. Pieces that rounding
/// turned into a line are dropped. The result may still hold intersections that rounding made: `cut_surfaces` looks.
/// Fails with unsupported beyond 32-bit indices.
Result<TriangleCut> cut_triangles(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                                  const std::vector<IntersectingPair>& pairs, const std::vector<char>& may_be_cut = {},
                                  const Vec3& origin = {});

}  // namespace strataflow
