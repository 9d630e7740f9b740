#include "kernels/topology/building/radial_order.h"

#include <algorithm>

#include "kernels/adapters/cgal/exact_predicates.h"

namespace strataflow {

namespace {

struct Leaf {
  std::uint32_t half_edge;
  std::uint32_t apex;
  int quadrant;  ///< 0 along the reference, 1 before the half turn, 2 at it, 3 after it
};

}  // namespace

RadialOrder radial_order(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                         std::span<const std::uint32_t> half_edges) {
  RadialOrder order;
  order.half_edges.assign(half_edges.begin(), half_edges.end());
  const Triangle& reference = triangles[half_edges[0] / 3];
  const std::uint32_t corner = half_edges[0] % 3;
  const Vec3& a = points[std::min(reference[corner], reference[(corner + 1) % 3])];
  const Vec3& b = points[std::max(reference[corner], reference[(corner + 1) % 3])];

  std::vector<Leaf> leaves;
  leaves.reserve(half_edges.size());
  for (const std::uint32_t h : half_edges) leaves.push_back({h, triangles[h / 3][(h % 3 + 2) % 3], 0});
  const Vec3& u = points[leaves[0].apex];
  const int axis = projection_axis(a, b, u);
  for (Leaf& leaf : leaves) {
    const Vec3& w = points[leaf.apex];
    if (axis < 0 || projection_axis(a, b, w) < 0) {
      order.is_ambiguous = true;
      return order;
    }
    const int turn = orientation_3d(a, b, u, w);
    const bool same_way = orientation_2d(a, b, u, axis) == orientation_2d(a, b, w, axis);
    leaf.quadrant = turn > 0 ? 1 : turn < 0 ? 3 : same_way ? 0 : 2;
  }
  const auto comes_before = [&](const Leaf& x, const Leaf& y) {
    if (x.quadrant != y.quadrant) return x.quadrant < y.quadrant;
    const int turn = x.quadrant % 2 == 1 ? orientation_3d(a, b, points[x.apex], points[y.apex]) : 0;
    if (turn != 0) return turn > 0;
    if (x.half_edge != y.half_edge) order.is_ambiguous = true;
    return x.half_edge < y.half_edge;
  };
  std::sort(leaves.begin(), leaves.end(), comes_before);
  if (order.is_ambiguous) return order;
  for (std::size_t i = 0; i < leaves.size(); ++i) order.half_edges[i] = leaves[i].half_edge;
  return order;
}

}  // namespace strataflow
