#pragma once
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include "io/read_input.h"
#include "kernels/complexity/measure_complexity.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "kernels/topology/building/build_structural_model.h"
#include "support/shapes.h"

namespace strataflow {

inline StructuralModel model_of(const TriangleSoup& soup) { return build_structural_model(soup)->model; }

inline StructuralModel reference_model(std::string_view name, double resolution_m) {
  return model_of(*generate_reference_model(name, {resolution_m}));
}

inline std::filesystem::path data_folder() {
  const char* folder = std::getenv("STRATAFLOW_DATA");
  return folder ? std::filesystem::path(folder) : std::filesystem::path(STRATAFLOW_SOURCE_DIR) / ".." / "shared" / "data";
}

/// A box 10 × 10 × 4 with a flat horizon at height 2 and a flat fault below it that meets it along y = const: they meet
/// at `angle_deg` on the side of larger x, at the middle of the box. The fault ends at the bottom.
inline TriangleSoup fault_below_horizon(double angle_deg) {
  const double reach = 2 / std::tan(angle_deg * std::numbers::pi / 180);  // of the fault, from top to bottom
  TriangleSoup soup;
  const std::uint32_t box = support::add_patch(soup, "box", Role::boundary);
  const std::uint32_t h = support::add_patch(soup, "H1", Role::horizon);
  const std::uint32_t f = support::add_patch(soup, "F1", Role::fault);
  const double m = 5, b = m + reach;
  support::add_quad(soup, h, {0, 0, 2}, {m, 0, 2}, {m, 10, 2}, {0, 10, 2});
  support::add_quad(soup, h, {m, 0, 2}, {20, 0, 2}, {20, 10, 2}, {m, 10, 2});
  support::add_quad(soup, f, {m, 0, 2}, {m, 10, 2}, {b, 10, 0}, {b, 0, 0});
  support::add_quad(soup, box, {0, 0, 0}, {0, 10, 0}, {b, 10, 0}, {b, 0, 0});
  support::add_quad(soup, box, {b, 0, 0}, {b, 10, 0}, {20, 10, 0}, {20, 0, 0});
  support::add_quad(soup, box, {0, 0, 4}, {20, 0, 4}, {20, 10, 4}, {0, 10, 4});
  for (const double y : {0.0, 10.0}) {
    support::add_quad(soup, box, {0, y, 0}, {b, y, 0}, {m, y, 2}, {0, y, 2});
    support::add_quad(soup, box, {m, y, 2}, {b, y, 0}, {20, y, 0}, {20, y, 2});
    support::add_triangle(soup, box, {0, y, 2}, {m, y, 2}, {0, y, 4});
    support::add_triangle(soup, box, {m, y, 2}, {20, y, 4}, {0, y, 4});
    support::add_triangle(soup, box, {m, y, 2}, {20, y, 2}, {20, y, 4});
  }
  for (const double x : {0.0, 20.0}) {
    support::add_quad(soup, box, {x, 0, 0}, {x, 10, 0}, {x, 10, 2}, {x, 0, 2});
    support::add_quad(soup, box, {x, 0, 2}, {x, 10, 2}, {x, 10, 4}, {x, 0, 4});
  }
  return soup;
}

inline GeometricComplexity geometric_of(const StructuralModel& model, double edge_length_m, double angle_deg = 20) {
  const BoxElements box = find_box_elements(model);
  return measure_geometric_complexity(model, box, sample_geometry(model, box, edge_length_m), edge_length_m, angle_deg);
}

/// A copy, turned, scaled and moved.
inline TriangleSoup placed(TriangleSoup soup, double scale, const Vec3& move, double turn_deg = 0) {
  const double c = std::cos(turn_deg * std::numbers::pi / 180), s = std::sin(turn_deg * std::numbers::pi / 180);
  for (Vec3& p : soup.points) {
    const Vec3 about_z{c * p.x - s * p.y, s * p.x + c * p.y, p.z};
    p = scale * Vec3{about_z.x, c * about_z.y - s * about_z.z, s * about_z.y + c * about_z.z} + move;
  }
  return soup;
}

/// Every triangle cut into four.
inline TriangleSoup refined(const TriangleSoup& soup) {
  TriangleSoup fine = soup;
  fine.points.clear();
  fine.triangles.clear();
  fine.triangle_patch.clear();
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const Vec3 &a = soup.points[soup.triangles[t][0]], &b = soup.points[soup.triangles[t][1]],
               &c = soup.points[soup.triangles[t][2]];
    const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    support::add_triangle(fine, soup.triangle_patch[t], a, ab, ca);
    support::add_triangle(fine, soup.triangle_patch[t], ab, b, bc);
    support::add_triangle(fine, soup.triangle_patch[t], ca, bc, c);
    support::add_triangle(fine, soup.triangle_patch[t], ab, bc, ca);
  }
  return fine;
}

}  // namespace strataflow
