#include "kernels/contacts/surface_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace strataflow {

Vec3 nearest_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double whole = dot(ab, ab);
  const double t = whole > 0 ? dot(p - a, ab) / whole : 0;
  if (!(t > 0)) return a;
  if (t >= 1) return b;
  Vec3 q = a + t * ab;
  for (int axis = 0; axis < 3; ++axis)
    if (a[axis] == b[axis]) q[axis] = a[axis];
  return q;
}

Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = cross(b - a, c - a);
  const double area = dot(n, n);
  const double u = dot(cross(b - p, c - p), n), v = dot(cross(c - p, a - p), n), w = dot(cross(a - p, b - p), n);
  if (area > 0 && u > 0 && v > 0 && w > 0) {
    const double sum = u + v + w;
    Vec3 q = a + (v / sum) * (b - a) + (w / sum) * (c - a);
    for (int axis = 0; axis < 3; ++axis)
      if (a[axis] == b[axis] && b[axis] == c[axis]) q[axis] = a[axis];
    return q;
  }
  Vec3 best;
  double best_m = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : {std::pair{&a, &b}, std::pair{&b, &c}, std::pair{&c, &a}}) {
    const Vec3 q = nearest_on_segment(p, *from, *to);
    const double d = length(q - p);
    if (d < best_m) {
      best_m = d;
      best = q;
    }
  }
  return best;
}

SurfaceSearch::SurfaceSearch(ContactMesh& mesh, std::uint32_t entity)
    : mesh_(mesh), entity_(entity), moves_(mesh.moves_of(entity)) {
  mesh.start_pieces(entity);
  std::vector<FloatBox> boxes;
  for (const std::uint32_t t : mesh.triangles_of(entity)) {
    if (!mesh.is_alive(t)) continue;
    Box3 box;
    for (const std::uint32_t v : mesh.triangle(t)) box.take(mesh.point(v));
    items_.push_back(t);
    boxes.push_back(enclosing(box));
  }
  tree_ = BoundingVolumeTree(boxes);
}

std::optional<Impact> SurfaceSearch::nearest(const Vec3& p, double limit_m) const {
  if (items_.empty()) return std::nullopt;
  const double whole = 2 * mesh_.diagonal_m();
  const double limit = std::min(limit_m, whole);
  // Cubes that grow until one holds a place nearer than its own half width.
  for (double radius = std::min(limit, 1e-3 * whole);; radius = std::min(limit, 4 * radius)) {
    Impact best;
    best.distance_m = std::numeric_limits<double>::infinity();
    visit_near(p, radius, [&](std::uint32_t t) {
      const Triangle& tri = mesh_.triangle(t);
      const Vec3 q = nearest_on_triangle(p, mesh_.point(tri[0]), mesh_.point(tri[1]), mesh_.point(tri[2]));
      const double d = length(q - p);
      if (d < best.distance_m || (d == best.distance_m && t < best.triangle)) best = {t, q, d};
    });
    if (best.distance_m <= radius) return best;
    if (radius >= limit) return std::nullopt;
  }
}

std::optional<Impact> SurfaceSearch::along(const Vec3& p, const Vec3& direction, double reach_m) const {
  Box3 box;
  box.take(p - reach_m * direction);
  box.take(p + reach_m * direction);
  std::optional<Impact> best;
  visit_in(box, [&](std::uint32_t t) {
    const Triangle& tri = mesh_.triangle(t);
    const Vec3 &a = mesh_.point(tri[0]), &b = mesh_.point(tri[1]), &c = mesh_.point(tri[2]);
    const Vec3 n = cross(b - a, c - a);
    const double slope = dot(n, direction);
    if (!(std::abs(slope) > 1e-9 * length(n))) return;
    const Vec3 hit = p + (dot(n, a - p) / slope) * direction;
    const Vec3 q = nearest_on_triangle(hit, a, b, c);  // on its plane but for rounding, and inside
    const double d = length(q - p);
    if (length(q - hit) > 1e-9 * (d + length(b - a)) || !(d <= reach_m)) return;
    if (!best || d < best->distance_m || (d == best->distance_m && t < best->triangle)) best = Impact{t, q, d};
  });
  return best;
}

}  // namespace strataflow
