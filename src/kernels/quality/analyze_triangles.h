#pragma once
#include <array>
#include <cstdint>
#include <span>

#include "kernels/quality/distribution.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// The shape of one triangle. A degenerate triangle has area, quality and radius ratio 0.
struct TriangleShape {
  double area_m2 = 0;
  std::array<double, 3> angles_deg{};  ///< at the first, second, third vertex
  double quality = 0;       ///< 6 S / (√3 h_max p), p half the perimeter; 1 if equilateral (pellerin2014 §2.9)
  double radius_ratio = 0;  ///< 2 r_in / R_circum; 1 if equilateral
};

TriangleShape measure_triangle(const Vec3& a, const Vec3& b, const Vec3& c);

/// Quality of a triangulated surface mesh (pellerin2014 §2.9). `min_angle_deg` is 0 for a mesh without triangles.
struct TriangleQualityReport {
  std::uint64_t triangles = 0;
  std::uint64_t degenerate = 0;  ///< area 0 in floating point
  double area_m2 = 0;
  double min_angle_deg = 0;
  double angles_below_30_ratio = 0;  ///< share of all 3 n angles
  double mean_quality = 0;
  Distribution angle_deg;     ///< all angles
  Distribution quality;       ///< Pellerin's Q, per triangle
  Distribution radius_ratio;  ///< per triangle
  template <class A>
  void archive(A& a) {
    a(triangles, degenerate, area_m2, min_angle_deg, angles_below_30_ratio, mean_quality, angle_deg, quality,
      radius_ratio);
  }
};

/// Measures every triangle. Needs indices in range.
TriangleQualityReport analyze_triangles(std::span<const Vec3> points, std::span<const Triangle> triangles);

}  // namespace strataflow
