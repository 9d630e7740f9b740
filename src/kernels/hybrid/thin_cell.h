#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "kernels/hybrid/facing_triangles.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// A cell by its vertices in VTK's order.
struct ThinCell {
  CellType type = CellType::tetrahedron;
  std::array<std::uint32_t, 6> vertices{};
};

inline ThinCell tetrahedron_of(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  return {CellType::tetrahedron, {a, b, c, d}};
}

/// The cell between two triangles, whose corners may coincide pairwise: a prism, a pyramid or a tetrahedron.
ThinCell cell_between(const Triangle& bottom, const Triangle& top);

/// The cells between `apex` and a face, which turns counter-clockwise seen from outside. face[3] is no_index for a
/// triangle.
ThinCell cone_over(const std::array<std::uint32_t, 4>& face, std::uint32_t apex);

/// Whether a cell can be kept.
enum class ThinCellState : std::uint8_t {
  sound,
  flat,     ///< positive at every corner, but with a scaled Jacobian below 1e-3
  inverted  ///< not positive at every corner, exactly; or a prism so twisted that it might not be inside
};

/// Positive corners make pyramids positive everywhere: their determinant is bilinear over the base. That of a prism is
/// quadratic along its height; it is positive if its Bernstein coefficients are, at each of the three links.

ThinCellState state_of(const ThinCell& cell, const std::vector<Vec3>& points);

double volume_of(const ThinCell& cell, const std::vector<Vec3>& points);

}  // namespace strataflow
