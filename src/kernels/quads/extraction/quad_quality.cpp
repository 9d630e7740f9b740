#include "kernels/quads/extraction/quad_quality.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kernels/quads/extraction/check_quads.h"

namespace strataflow {

namespace {

/// Per quad the sum of the normals of itself and those of its patch that share a vertex, weighted by area.
std::vector<Vec3> mean_normals(const QuadMesh& mesh) {
  const std::vector<std::uint32_t> patch = smooth_patches(mesh.quads, mesh.edges);
  struct Corner {
    std::uint32_t point, patch;
    Vec3 normal;
  };
  std::vector<Corner> corners;  // one per vertex and patch in the end
  for (std::uint32_t i = 0; i < mesh.quads.size(); ++i) {
    const auto& q = mesh.quads[i];
    const Vec3 n = cross(mesh.points[q[2]] - mesh.points[q[0]], mesh.points[q[3]] - mesh.points[q[1]]);
    for (const std::uint32_t p : q) corners.push_back({p, patch[i], n});
  }
  const auto before = [](const Corner& a, const Corner& b) {
    return a.point != b.point ? a.point < b.point : a.patch < b.patch;
  };
  std::stable_sort(corners.begin(), corners.end(), before);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (kept > 0 && !before(corners[kept - 1], corners[i]))
      corners[kept - 1].normal = corners[kept - 1].normal + corners[i].normal;
    else
      corners[kept++] = corners[i];
  }
  corners.resize(kept);
  std::vector<Vec3> normals(mesh.quads.size());
  for (std::uint32_t i = 0; i < mesh.quads.size(); ++i)
    for (const std::uint32_t p : mesh.quads[i])
      normals[i] = normals[i] + std::lower_bound(corners.begin(), corners.end(), Corner{p, patch[i], {}}, before)->normal;
  return normals;
}

}  // namespace

QuadShape quad_shape(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& normal) {
  const Vec3 corner[4] = {a, b, c, d};
  Vec3 own = cross(c - a, d - b);
  if (dot(own, normal) < 0) own = -1 * own;
  const double size = length(own);
  if (!(size > 0)) return {-1, 4};
  QuadShape shape;
  for (int k = 0; k < 4; ++k) {
    const Vec3 u = corner[(k + 1) % 4] - corner[k], v = corner[(k + 3) % 4] - corner[k];
    const double uu = dot(u, u), vv = dot(v, v), area = dot(cross(u, v), own) / size;
    shape.scaled_jacobian = std::min(shape.scaled_jacobian, uu * vv > 0 ? area / std::sqrt(uu * vv) : -1.0);
    const double off = uu + vv > 0 ? 1 - 2 * area / (uu + vv) : 2.0;
    shape.distortion += off * off;
  }
  return shape;
}

double smallest_scaled_jacobian(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d, const Vec3& normal) {
  return quad_shape(a, b, c, d, normal).scaled_jacobian;
}

QuadQuality measure_quads(const QuadMesh& mesh) {
  QuadQuality quality;
  const bool is_plane = std::all_of(mesh.points.begin(), mesh.points.end(), [](const Vec3& p) { return p.z == 0; });
  const std::vector<Vec3> normals = is_plane ? std::vector<Vec3>(mesh.quads.size(), {0, 0, 1}) : mean_normals(mesh);
  double longest = 0;
  for (const auto& q : mesh.quads)
    for (int k = 0; k < 4; ++k) longest = std::max(longest, length(mesh.points[q[(k + 1) % 4]] - mesh.points[q[k]]));
  quality.edge_length_m = Distribution("edge_length_m", 0, longest > 0 ? longest : 1, 40);
  double worst = 2;
  const auto boundary = boundary_points(mesh);
  for (std::uint32_t i = 0; i < mesh.quads.size(); ++i) {
    const auto& q = mesh.quads[i];
    const double jacobian = smallest_scaled_jacobian(mesh.points[q[0]], mesh.points[q[1]], mesh.points[q[2]],
                                                     mesh.points[q[3]], normals[i]);
    quality.scaled_jacobian.add(jacobian);
    if (!(jacobian > 0)) ++quality.inverted;
    if (jacobian < worst) {
      worst = jacobian;
      quality.worst_quad = i;
    }
    for (int k = 0; k < 4; ++k) {
      const std::uint32_t at = q[k], to = q[(k + 1) % 4];
      const Vec3 u = mesh.points[to] - mesh.points[at], v = mesh.points[q[(k + 3) % 4]] - mesh.points[at];
      quality.angle_deg.add(std::atan2(length(cross(u, v)), dot(u, v)) * 180 / std::numbers::pi);
      // An edge inside is met from both sides: once is enough.
      if (at < to || (boundary[at] && boundary[to])) quality.edge_length_m.add(length(u));
    }
  }
  const auto valence = quad_valence(mesh);
  for (std::size_t p = 0; p < valence.size(); ++p) {
    std::vector<std::uint64_t>& points = boundary[p] ? quality.boundary_valence : quality.interior_valence;
    if (points.size() <= valence[p]) points.resize(valence[p] + 1, 0);
    ++points[valence[p]];
    quality.interior_irregular += !boundary[p] && valence[p] != 4;
  }
  return quality;
}

}  // namespace strataflow
