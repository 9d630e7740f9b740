#include "kernels/hybrid/thin_cell.h"

#include <span>

#include "kernels/quality/measure_cell.h"

namespace strataflow {

namespace {

std::array<Vec3, 6> corners_of(const ThinCell& cell, const std::vector<Vec3>& points) {
  std::array<Vec3, 6> corners;
  for (int i = 0; i < vertex_count(cell.type); ++i) corners[i] = points[cell.vertices[i]];
  return corners;
}

/// Whether the middle Bernstein coefficients of a prism's determinant are positive.
bool is_untwisted(const std::array<Vec3, 6>& p) {
  const Vec3 u0 = p[2] - p[0], v0 = p[1] - p[0], u1 = p[5] - p[3], v1 = p[4] - p[3];
  const Vec3 middle = cross(u0, v1) + cross(u1, v0);
  return dot(middle, p[3] - p[0]) > 0 && dot(middle, p[4] - p[1]) > 0 && dot(middle, p[5] - p[2]) > 0;
}

}  // namespace

ThinCell cell_between(const Triangle& b, const Triangle& t) {
  int shared = 0, last_shared = 0, last_free = 0;
  for (int k = 0; k < 3; ++k) (b[k] == t[k] ? (++shared, last_shared) : last_free) = k;
  const int j = (last_shared + 1) % 3, k = (last_shared + 2) % 3;
  if (shared == 0) return {CellType::prism, {b[0], b[2], b[1], t[0], t[2], t[1]}};
  if (shared == 1) return {CellType::pyramid, {b[j], t[j], t[k], b[k], b[last_shared]}};
  return tetrahedron_of(b[(last_free + 1) % 3], b[(last_free + 2) % 3], b[last_free], t[last_free]);
}

ThinCell cone_over(const std::array<std::uint32_t, 4>& face, std::uint32_t apex) {
  if (face[3] == no_index) return tetrahedron_of(face[0], face[2], face[1], apex);
  return {CellType::pyramid, {face[0], face[3], face[2], face[1], apex}};
}

ThinCellState state_of(const ThinCell& cell, const std::vector<Vec3>& points) {
  constexpr double least_scaled_jacobian = 1e-3;  // flatter ones give nobody joy, and checks their rounding errors
  const auto corners = corners_of(cell, points);
  const auto used = std::span(corners).first(vertex_count(cell.type));
  if (is_inverted(cell.type, used) || (cell.type == CellType::prism && !is_untwisted(corners)))
    return ThinCellState::inverted;
  return measure_cell(cell.type, used).scaled_jacobian >= least_scaled_jacobian ? ThinCellState::sound
                                                                                : ThinCellState::flat;
}

double volume_of(const ThinCell& cell, const std::vector<Vec3>& points) {
  const auto corners = corners_of(cell, points);
  return cell_volume(cell.type, std::span(corners).first(vertex_count(cell.type)));
}

}  // namespace strataflow
