#include "kernels/quality/measure_cell.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "kernels/adapters/cgal/exact_predicates.h"

namespace strataflow {

namespace {

constexpr std::uint8_t none = no_local_vertex;

constexpr LocalFace tetrahedron_faces[] = {{0, 2, 1, none}, {0, 1, 3, none}, {1, 2, 3, none}, {0, 3, 2, none}};
constexpr LocalFace pyramid_faces[] = {
    {0, 3, 2, 1}, {0, 1, 4, none}, {1, 2, 4, none}, {2, 3, 4, none}, {3, 0, 4, none}};
constexpr LocalFace prism_faces[] = {{0, 1, 2, none}, {3, 5, 4, none}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
constexpr LocalFace hexahedron_faces[] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                          {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};

constexpr CornerFrame tetrahedron_corners[] = {{0, {1, 2, 3}}, {1, {2, 0, 3}}, {2, {0, 1, 3}}, {3, {1, 0, 2}}};
constexpr CornerFrame pyramid_corners[] = {{0, {1, 3, 4}}, {1, {2, 0, 4}}, {2, {3, 1, 4}}, {3, {0, 2, 4}}};
constexpr CornerFrame pyramid_apex[] = {{4, {1, 0, 3}}, {4, {2, 1, 0}}, {4, {3, 2, 1}}, {4, {0, 3, 2}}};
constexpr CornerFrame prism_corners[] = {{0, {2, 1, 3}}, {1, {0, 2, 4}}, {2, {1, 0, 5}},
                                         {3, {4, 5, 0}}, {4, {5, 3, 1}}, {5, {3, 4, 2}}};
constexpr CornerFrame hexahedron_corners[] = {{0, {1, 3, 4}}, {1, {2, 0, 5}}, {2, {3, 1, 6}}, {3, {0, 2, 7}},
                                              {4, {7, 5, 0}}, {5, {4, 6, 1}}, {6, {5, 7, 2}}, {7, {6, 4, 3}}};

constexpr double two_thirds = 2.0 / 3.0;

/// Six times the volume between the origin and a face; a quadrilateral counts as the mean of its two triangulations,
/// which is what its bilinear patch encloses.
double six_cone_volumes(const Vec3& a, const Vec3& b, const Vec3& c) { return dot(a, cross(b, c)); }

double volume_of(const CellShape& shape, std::span<const Vec3> p) {
  double six_volumes = 0;
  for (const LocalFace& face : shape.faces) {
    const Vec3 a = p[face[0]] - p[0], b = p[face[1]] - p[0], c = p[face[2]] - p[0];
    if (face[3] == none) {
      six_volumes += six_cone_volumes(a, b, c);
      continue;
    }
    const Vec3 d = p[face[3]] - p[0];
    six_volumes += 0.5 * (six_cone_volumes(a, b, c) + six_cone_volumes(a, c, d) + six_cone_volumes(a, b, d) +
                          six_cone_volumes(b, c, d));
  }
  return six_volumes / 6;
}

/// 3 r_in / R_circum of the tetrahedron with edge vectors a, b, c from one vertex.
double tetrahedron_radius_ratio(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  const double determinant = dot(a, bc);
  const double twice_surface = length(bc) + length(ca) + length(ab) + length(bc + ca + ab);
  // r = 3 V / S and R = |to_centre| / (2 det), with V = det / 6.
  const double to_centre = length(dot(a, a) * bc + dot(b, b) * ca + dot(c, c) * ab);
  return determinant > 0 ? 6 * determinant / twice_surface * (determinant / to_centre) : 0;
}

}  // namespace

const CellShape& shape_of(CellType type) {
  static constexpr CellShape tetrahedron{tetrahedron_faces, tetrahedron_corners, {}, std::numbers::sqrt2};
  static constexpr CellShape pyramid{pyramid_faces, pyramid_corners, pyramid_apex, std::numbers::sqrt2};
  static constexpr CellShape prism{prism_faces, prism_corners, {}, 2 * std::numbers::inv_sqrt3};
  static constexpr CellShape hexahedron{hexahedron_faces, hexahedron_corners, {}, 1};
  switch (type) {
    case CellType::tetrahedron:
      return tetrahedron;
    case CellType::pyramid:
      return pyramid;
    case CellType::prism:
      return prism;
    case CellType::hexahedron:
      break;
  }
  return hexahedron;
}

CellMeasures measure_cell(CellType type, std::span<const Vec3> p) {
  const CellShape& cell = shape_of(type);
  CellMeasures measures;
  measures.volume_m3 = volume_of(cell, p);
  double worst = std::numeric_limits<double>::infinity();
  double sum = 0, shape_sum = 0, skew_sum = 0;
  bool is_positive = true;
  const auto take_scaled = [&](double determinant, double lengths) {
    worst = std::min(worst, lengths > 0 ? determinant / lengths : 0);
  };
  for (const CornerFrame& frame : cell.corners) {
    const std::array<Vec3, 3> edge{p[frame.ends[0]] - p[frame.corner], p[frame.ends[1]] - p[frame.corner],
                                   p[frame.ends[2]] - p[frame.corner]};
    const std::array<Vec3, 3> normal{cross(edge[1], edge[2]), cross(edge[2], edge[0]), cross(edge[0], edge[1])};
    const std::array<double, 3> squared{dot(edge[0], edge[0]), dot(edge[1], edge[1]), dot(edge[2], edge[2])};
    const double determinant = dot(edge[0], normal[0]);
    const double lengths = std::sqrt(squared[0]) * std::sqrt(squared[1]) * std::sqrt(squared[2]);
    for (int i = 0; i < 3; ++i) {
      if (type == CellType::tetrahedron && frame.ends[i] < frame.corner) continue;  // seen from its other end
      // The two face normals at edge i have the cross product edge_i · det.
      measures.dihedral_deg[measures.dihedral_count++] =
          std::atan2(std::sqrt(squared[i]) * std::abs(determinant), -dot(normal[(i + 1) % 3], normal[(i + 2) % 3])) *
          (180.0 / std::numbers::pi);
    }
    take_scaled(determinant, lengths);
    sum += determinant;
    if (!(determinant > 0)) {
      is_positive = false;
    } else if (type == CellType::hexahedron) {
      shape_sum += (squared[0] + squared[1] + squared[2]) / std::pow(determinant, two_thirds);
      skew_sum += std::pow(lengths / determinant, two_thirds);
    } else if (type == CellType::prism) {
      // |A W⁻¹|² and det(A W⁻¹), W the frame of an equilateral triangle extruded by its edge length.
      const double norm = 4.0 / 3.0 * (squared[0] + squared[1] - dot(edge[0], edge[1])) + squared[2];
      shape_sum += norm / std::pow(determinant * 2 * std::numbers::inv_sqrt3, two_thirds);
    } else if (type == CellType::tetrahedron && frame.corner == 0) {  // every corner of a tetrahedron says the same
      const double norm = 1.5 * (squared[0] + squared[1] + squared[2]) - dot(edge[0], edge[1]) - dot(edge[1], edge[2]) -
                          dot(edge[2], edge[0]);
      shape_sum = norm / std::pow(determinant * std::numbers::sqrt2, two_thirds);
    }
  }
  for (const CornerFrame& frame : cell.apex_corners) {
    const Vec3 a = p[frame.ends[0]] - p[frame.corner], b = p[frame.ends[1]] - p[frame.corner],
               c = p[frame.ends[2]] - p[frame.corner];
    take_scaled(dot(a, cross(b, c)), length(a) * length(b) * length(c));
  }
  const auto corner_count = static_cast<double>(cell.corners.size());
  measures.scaled_jacobian = worst * cell.ideal_factor;
  measures.mean_corner_determinant = sum / corner_count;
  if (type == CellType::tetrahedron) {
    measures.radius_ratio = tetrahedron_radius_ratio(p[1] - p[0], p[2] - p[0], p[3] - p[0]);
    measures.shape = is_positive ? 3 / shape_sum : 0;
  } else if (type != CellType::pyramid) {
    measures.shape = is_positive ? 3 * corner_count / shape_sum : 0;
  }
  if (type == CellType::hexahedron) measures.skew = is_positive ? corner_count / skew_sum : 0;
  return measures;
}

double cell_volume(CellType type, std::span<const Vec3> vertices) { return volume_of(shape_of(type), vertices); }

double relative_size(double mean_corner_determinant, double reference_determinant) {
  const double tau = mean_corner_determinant / reference_determinant;
  return tau > 0 ? std::min(tau, 1 / tau) : 0;
}

bool is_inverted(CellType type, std::span<const Vec3> p) {
  const CellShape& cell = shape_of(type);
  // The four corners of a tetrahedron have one determinant.
  for (const CornerFrame& frame : cell.corners.first(type == CellType::tetrahedron ? 1 : cell.corners.size()))
    if (orientation_3d(p[frame.corner], p[frame.ends[0]], p[frame.ends[1]], p[frame.ends[2]]) <= 0) return true;
  return false;
}

}  // namespace strataflow
