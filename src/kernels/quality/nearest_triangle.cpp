#include "kernels/quality/nearest_triangle.h"

#include <limits>

#include "graph/parallel/parallel_map.h"

namespace strataflow {

namespace {
constexpr std::size_t grain = 4096;
}

NearestTriangle::NearestTriangle(const TriangleMesh& mesh) {
  const std::size_t count = mesh.triangles.size();
  tree_ = BoundingVolumeTree(parallel_map(
      count,
      [&](std::size_t t) {
        Box3 box;
        for (const std::uint32_t v : mesh.triangles[t]) box.take(mesh.points[v]);
        return enclosing(box);
      },
      grain));
  shapes_.resize(count);
  place_of_.resize(count);
  parallel_ranges(count, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t place = begin; place < end; ++place) {
      const std::uint32_t t = tree_.item_at(static_cast<std::uint32_t>(place));
      const Vec3& a = mesh.points[mesh.triangles[t][0]];
      shapes_[place] = {a, mesh.points[mesh.triangles[t][1]] - a, mesh.points[mesh.triangles[t][2]] - a};
      place_of_[t] = static_cast<std::uint32_t>(place);
    }
  });
}

/// By the Voronoi region of the triangle's corners, edges and inside that p projects into (Ericson 2005, §5.1.5).
double NearestTriangle::squared_m2(const Vec3& p, const Shape& shape) {
  const Vec3 &ab = shape.ab, &ac = shape.ac, ap = p - shape.a;
  const auto squared = [](const Vec3& v) { return dot(v, v); };
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return squared(ap);
  const Vec3 bp = ap - ab;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return squared(bp);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return squared(ap - (d1 / (d1 - d3)) * ab);
  const Vec3 cp = ap - ac;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return squared(cp);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return squared(ap - (d2 / (d2 - d6)) * ac);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return squared(bp - ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (ac - ab));
  const double sum = va + vb + vc;
  return squared(ap - (vb / sum) * ab - (vc / sum) * ac);
}

double NearestTriangle::squared_m2(const Vec3& p, std::uint32_t triangle) const {
  return squared_m2(p, shapes_[place_of_[triangle]]);
}

NearestTriangle::Hit NearestTriangle::nearest(const Vec3& p, std::uint32_t guess) const {
  Hit best{guess, guess == no_index ? std::numeric_limits<double>::infinity() : squared_m2(p, guess)};
  tree_.visit_nearest(p, best.squared_m2, [&](std::uint32_t place) {
    const double squared = squared_m2(p, shapes_[place]);
    if (squared <= best.squared_m2) {
      const std::uint32_t triangle = tree_.item_at(place);
      if (squared < best.squared_m2 || triangle < best.triangle) best = {triangle, squared};
    }
    return best.squared_m2;
  });
  return best;
}

bool NearestTriangle::is_within(const Vec3& p, double squared_m2, std::uint32_t& guess) const {
  if (guess != no_index && this->squared_m2(p, guess) <= squared_m2) return true;
  bool is_found = false;
  tree_.visit_nearest(p, squared_m2, [&](std::uint32_t place) {
    if (!(this->squared_m2(p, shapes_[place]) <= squared_m2)) return squared_m2;
    is_found = true;
    guess = tree_.item_at(place);
    return -1.0;  // nothing is nearer than that
  });
  return is_found;
}

}  // namespace strataflow
