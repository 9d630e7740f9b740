#include "kernels/adapters/cgal/exact_predicates.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>

#include <vector>

namespace strataflow::exact {

namespace {
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
Kernel::Point_3 point(const Vec3& p) { return {p.x, p.y, p.z}; }
}  // namespace

int orientation_3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return static_cast<int>(CGAL::orientation(point(a), point(b), point(c), point(d)));
}

int orientation_2d(double ax, double ay, double bx, double by, double cx, double cy) {
  using Point = Kernel::Point_2;
  return static_cast<int>(CGAL::orientation(Point(ax, ay), Point(bx, by), Point(cx, cy)));
}

int signed_volume_sign(std::span<const Vec3> points, std::span<const Triangle> triangles) {
  using Number = CGAL::Exact_rational;
  Number sum = 0;
  for (const Triangle& t : triangles) {
    const Vec3 &a = points[t[0]], &b = points[t[1]], &c = points[t[2]];
    const Number bx(b.x), by(b.y), bz(b.z), cx(c.x), cy(c.y), cz(c.z);
    sum += Number(a.x) * (by * cz - bz * cy) + Number(a.y) * (bz * cx - bx * cz) + Number(a.z) * (bx * cy - by * cx);
  }
  return static_cast<int>(CGAL::sign(sum));
}

}  // namespace strataflow::exact
