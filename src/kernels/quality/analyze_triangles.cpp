#include "kernels/quality/analyze_triangles.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "graph/parallel/ordered_reduce.h"

namespace strataflow {

namespace {

constexpr double degrees = 180.0 / std::numbers::pi;

TriangleQualityReport empty_report() {
  TriangleQualityReport report;
  report.angle_deg = Distribution("angle_deg", 0, 180, 36);
  report.quality = Distribution("quality", 0, 1, 20);
  report.radius_ratio = Distribution("radius_ratio", 0, 1, 20);
  return report;
}

}  // namespace

TriangleShape measure_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const double twice_area = length(cross(ab, ca));
  const double h0 = length(ab), h1 = length(bc), h2 = length(ca);
  TriangleShape shape;
  shape.area_m2 = 0.5 * twice_area;
  shape.angles_deg = {std::atan2(twice_area, -dot(ca, ab)) * degrees, std::atan2(twice_area, -dot(ab, bc)) * degrees,
                      std::atan2(twice_area, -dot(bc, ca)) * degrees};
  if (!(twice_area > 0)) return shape;
  const double half_perimeter = 0.5 * (h0 + h1 + h2);
  shape.quality = 3 * twice_area / (std::numbers::sqrt3 * std::max({h0, h1, h2}) * half_perimeter);
  // r = S / p and R = h0 h1 h2 / (4 S), hence 2 r / R = 8 S² / (p h0 h1 h2).
  shape.radius_ratio = 2 * twice_area / half_perimeter * (twice_area / (h0 * h1 * h2));
  return shape;
}

TriangleQualityReport analyze_triangles(std::span<const Vec3> points, std::span<const Triangle> triangles) {
  const std::size_t blocks = (triangles.size() + reduce_grain - 1) / reduce_grain;
  std::vector<std::uint64_t> small_angles(blocks, 0);
  const auto partial = parallel_map(blocks, [&](std::size_t block) {
    TriangleQualityReport part = empty_report();
    const std::size_t end = std::min(triangles.size(), (block + 1) * reduce_grain);
    for (std::size_t t = block * reduce_grain; t < end; ++t) {
      const auto [i, j, k] = triangles[t];
      const TriangleShape shape = measure_triangle(points[i], points[j], points[k]);
      part.degenerate += !(shape.area_m2 > 0);
      part.area_m2 += shape.area_m2;
      for (const double angle : shape.angles_deg) {
        part.angle_deg.add(angle);
        small_angles[block] += !(angle >= 30);
      }
      part.quality.add(shape.quality);
      part.radius_ratio.add(shape.radius_ratio);
    }
    return part;
  });
  TriangleQualityReport report = empty_report();
  report.triangles = triangles.size();
  std::uint64_t below_30 = 0;
  for (std::size_t block = 0; block < blocks; ++block) {  // in order: the sums depend on the blocks alone
    report.degenerate += partial[block].degenerate;
    report.area_m2 += partial[block].area_m2;
    report.angle_deg.add(partial[block].angle_deg);
    report.quality.add(partial[block].quality);
    report.radius_ratio.add(partial[block].radius_ratio);
    below_30 += small_angles[block];
  }
  report.min_angle_deg = report.angle_deg.minimum;
  report.mean_quality = report.quality.mean();
  if (!triangles.empty())
    report.angles_below_30_ratio = static_cast<double>(below_30) / static_cast<double>(report.angle_deg.count);
  return report;
}

}  // namespace strataflow
