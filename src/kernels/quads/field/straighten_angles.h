#pragma once
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "kernels/quads/field/feature_layout.h"

namespace strataflow {

/// Per corner: an angle close to the true one such that each triangle keeps the sum π, the sector at each feature
/// corner has as many right angles as `corner_quads` asks for, and the rest stays as flat as it can. A cross field is
/// compared between triangles in this metric, so acute and obtuse feature corners neither bend it nor make
/// singularities: one sparse solve, the role of Desobry 2021b in coudert2024 S11.
///
/// Angles of a sector that runs through are kept, so curved features turn the field as they are. What a corner gains
/// is taken from the points inside around it, about where its sector is a quad wide: a singular point lands there if a
/// quarter turn is needed (Gauss-Bonnet).
///
/// Fails with geometry_failed when a compartment needs singular points but has no point inside.
Result<std::vector<double>> straighten_angles(const FeatureMesh& mesh, const FeatureLayout& layout,
                                              const std::vector<std::uint8_t>& corner_quads);

/// Directions of the three half-edges of a triangle against the first, from the angles of its corners.
inline double half_edge_direction(const std::vector<double>& angle, std::uint32_t h) {
  constexpr double pi = 3.14159265358979323846;
  const std::uint32_t t = h - h % 3;
  return h % 3 == 0 ? 0.0 : h % 3 == 1 ? pi - angle[t + 1] : 2 * pi - angle[t + 1] - angle[t + 2];
}

}  // namespace strataflow
