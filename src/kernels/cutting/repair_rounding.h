#pragma once
#include <cstdint>
#include <vector>

#include "kernels/intersection/find_intersections.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// A mesh while it is being cut. `origin` is the input triangle each triangle is, or is a piece of.
struct CutMesh {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> origin;
  std::vector<char> is_changed;       ///< in the last round: look here for intersections
  std::size_t input_point_count = 0;  ///< points before this were there before cutting

  /// Leaves only the triangles marked, one mark per triangle, in their order.
  void keep(const std::vector<char>& is_kept);
};

struct RoundingRepair {
  std::uint64_t merged_points = 0;
  std::uint64_t split_edges = 0;
  std::uint64_t split_triangles = 0;
  double largest_move_m = 0;  ///< how far anything moved: a point, or an edge or triangle that now passes through one
  bool did_anything() const { return merged_points + split_edges + split_triangles > 0; }
};

/// Triangles that still meet improperly after rounding do so by a few units in the last place. Where a vertex of one
/// lies within `reach_m` of the other, a vertex, the longest edge or the triangle is made to pass through it; where two
/// edges do, both get a vertex there. Coarser contacts first: merging, then vertices on edges, then in triangles, then
/// edges on edges; one kind a call. Triangles that lose their area by it are dropped. Pairs with nothing in reach are
/// left alone. New points survive being moved by `origin`. Serial, in an
/// order that positions give: how points and triangles are numbered does not matter.
RoundingRepair repair_rounding(CutMesh& mesh, const std::vector<IntersectingPair>& pairs, double reach_m,
                               const Vec3& origin = {});

}  // namespace strataflow
