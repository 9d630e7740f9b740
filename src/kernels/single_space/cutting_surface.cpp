#include "kernels/single_space/cutting_surface.h"

#include <algorithm>

#include "kernels/adapters/cgal/exact_predicates.h"

namespace strataflow {

CuttingSurface::CuttingSurface(const std::vector<Vec3>& points, std::vector<Triangle> triangles)
    : points_(points), triangles_(std::move(triangles)) {
  std::vector<FloatBox> boxes;
  boxes.reserve(triangles_.size());
  for (const Triangle& t : triangles_) {
    Box3 box;
    for (const std::uint32_t v : t) box.take(points_[v]);
    boxes.push_back(enclosing(box));
  }
  tree_ = BoundingVolumeTree(boxes);
}

std::optional<CuttingSurface::Crossing> CuttingSurface::cross_segment(const Vec3& p, const Vec3& q) const {
  Box3 box;
  box.take(p);
  box.take(q);
  std::vector<Crossing> found;
  tree_.visit_items(enclosing(box), [&](std::uint32_t t) {
    const Vec3 &a = points_[triangles_[t][0]], &b = points_[triangles_[t][1]], &c = points_[triangles_[t][2]];
    // A point on the plane counts as above it: a segment then crosses in one triangle of a fan, never in none.
    const bool p_above = orientation_3d(a, b, c, p) >= 0, q_above = orientation_3d(a, b, c, q) >= 0;
    if (p_above == q_above) return;
    const int u = orientation_3d(p, q, a, b), v = orientation_3d(p, q, b, c), w = orientation_3d(p, q, c, a);
    if (std::min({u, v, w}) < 0 && std::max({u, v, w}) > 0) return;
    const Vec3 n = cross(b - a, c - a);
    const double to_p = dot(n, p - a), to_q = dot(n, q - a);
    const double share = to_p == to_q ? 0.5 : std::clamp(to_p / (to_p - to_q), 0.0, 1.0);
    found.push_back({p + share * (q - p), share, t, true});
  });
  if (found.empty()) return std::nullopt;
  std::sort(found.begin(), found.end(), [](const Crossing& x, const Crossing& y) {
    return x.share != y.share ? x.share < y.share : x.triangle < y.triangle;
  });
  constexpr double same_place = 1e-9;  // through an edge of the surface, two triangles report it
  found.front().is_single = found.back().share - found.front().share <= same_place;
  return found.front();
}

Vec3 CuttingSurface::normal(std::uint32_t triangle) const {
  const Triangle& t = triangles_[triangle];
  const Vec3 n = cross(points_[t[1]] - points_[t[0]], points_[t[2]] - points_[t[0]]);
  return (1 / length(n)) * n;
}

}  // namespace strataflow
