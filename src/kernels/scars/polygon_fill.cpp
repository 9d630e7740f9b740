#include "kernels/scars/polygon_fill.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kernels/adapters/cgal/exact_predicates.h"

namespace strataflow {

namespace {

/// Whether the segments pq and rs share a point, seen along `axis`.
bool segments_meet(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s, int axis) {
  const int p_side = orientation_2d(r, s, p, axis), q_side = orientation_2d(r, s, q, axis);
  if (p_side * q_side > 0 || orientation_2d(p, q, r, axis) * orientation_2d(p, q, s, axis) > 0) return false;
  if (p_side != 0 || q_side != 0) return true;
  for (int c = 0; c < 3; ++c)  // on one line: compare their extents
    if (c != axis && (std::max(p[c], q[c]) < std::min(r[c], s[c]) || std::max(r[c], s[c]) < std::min(p[c], q[c])))
      return false;
  return true;
}

/// b lies on the way from a to c and back: the sides ab and bc overlap.
bool turns_back(const Vec3& a, const Vec3& b, const Vec3& c, int axis) {
  if (orientation_2d(a, b, c, axis) != 0) return false;
  bool same_way = true;
  for (int k = 0; k < 3; ++k)
    if (k != axis && ((a[k] < b[k] && b[k] < c[k]) || (a[k] > b[k] && b[k] > c[k]))) same_way = false;
  return same_way;
}

}  // namespace

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double square = dot(d, d);
  const double t = square > 0 ? std::clamp(dot(p - a, d) / square, 0.0, 1.0) : 0.0;
  return length(p - (a + t * d));
}

std::optional<ProjectedPolygon> project_polygon(const std::vector<Vec3>& points,
                                                std::span<const std::uint32_t> polygon) {
  const std::size_t n = polygon.size();
  const auto at = [&](std::size_t i) -> const Vec3& { return points[polygon[i % n]]; };
  Vec3 normal;
  for (std::size_t i = 1; i + 1 < n; ++i) normal = normal + cross(at(i) - at(0), at(i + 1) - at(0));
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
  if (!(std::abs(normal[axis]) > 0)) return std::nullopt;
  for (std::size_t i = 0; i < n; ++i) {
    if (turns_back(at(i), at(i + 1), at(i + 2), axis)) return std::nullopt;
    for (std::size_t j = i + 2; j < n; ++j)
      if ((j + 1) % n != i && segments_meet(at(i), at(i + 1), at(j), at(j + 1), axis)) return std::nullopt;
  }
  return ProjectedPolygon{axis, (normal[axis] > 0) == (axis != 1) ? 1 : -1};  // along y, (x, z) is left-handed
}

std::optional<std::vector<Triangle>> fill_polygon(const std::vector<Vec3>& points,
                                                  std::span<const std::uint32_t> polygon,
                                                  std::span<const char> is_taken) {
  const std::optional<ProjectedPolygon> plane = project_polygon(points, polygon);
  if (!plane) return std::nullopt;
  const std::size_t n = polygon.size();
  constexpr double none = std::numeric_limits<double>::infinity();
  std::vector<double> cost(n * n, none);  // [i·n + j]: best filling of the nodes i … j closed by the diagonal ij
  std::vector<std::size_t> apex(n * n, 0);
  for (std::size_t i = 0; i + 1 < n; ++i) cost[i * n + i + 1] = 0;
  for (std::size_t span = 2; span < n; ++span)
    for (std::size_t i = 0; i + span < n; ++i) {
      const std::size_t j = i + span;
      const bool is_side = i == 0 && j + 1 == n;
      if (!is_side && !is_taken.empty() && is_taken[i * n + j]) continue;
      const Vec3 &a = points[polygon[i]], &c = points[polygon[j]];
      for (std::size_t k = i + 1; k < j; ++k) {
        const double parts = cost[i * n + k] + cost[k * n + j];
        const Vec3& b = points[polygon[k]];
        if (parts == none || plane->turn * orientation_2d(a, b, c, plane->axis) <= 0) continue;
        const double total =
            parts + (dot(b - a, b - a) + dot(c - b, c - b) + dot(a - c, a - c)) / length(cross(b - a, c - a));
        if (total < cost[i * n + j]) {
          cost[i * n + j] = total;
          apex[i * n + j] = k;
        }
      }
    }
  if (!(cost[n - 1] < none)) return std::nullopt;
  std::vector<Triangle> triangles;
  std::vector<std::pair<std::size_t, std::size_t>> open{{0, n - 1}};
  for (std::size_t next = 0; next < open.size(); ++next) {
    const auto [i, j] = open[next];
    if (j == i + 1) continue;
    const std::size_t k = apex[i * n + j];
    triangles.push_back({polygon[i], polygon[k], polygon[j]});
    open.push_back({i, k});
    open.push_back({k, j});
  }
  return triangles;
}

std::optional<std::vector<Triangle>> fill_quad(const std::vector<Vec3>& points, std::span<const std::uint32_t> polygon,
                                               const Vec3& deleted_node, QuadDiagonal wanted,
                                               std::span<const char> is_taken, std::size_t on_tie) {
  const std::optional<ProjectedPolygon> plane = project_polygon(points, polygon);
  if (!plane) return std::nullopt;
  const auto at = [&](std::size_t i) -> const Vec3& { return points[polygon[i % 4]]; };
  const auto rank = [&](std::size_t i) {
    return wanted == QuadDiagonal::shortest ? length(at(i + 2) - at(i))
                                            : distance_to_segment(deleted_node, at(i), at(i + 2));
  };
  constexpr double near_tie = 1e-6;
  const double ranks[] = {rank(0), rank(1)};
  const bool is_tie = std::abs(ranks[0] - ranks[1]) <= near_tie * length(at(2) - at(0));
  const std::size_t first = is_tie ? on_tie : ranks[1] < ranks[0] ? 1 : 0;
  for (const std::size_t i : {first, 1 - first}) {
    if (!is_taken.empty() && is_taken[i * 4 + i + 2]) continue;
    if (plane->turn * orientation_2d(at(i), at(i + 1), at(i + 2), plane->axis) > 0 &&
        plane->turn * orientation_2d(at(i), at(i + 2), at(i + 3), plane->axis) > 0)
      return std::vector<Triangle>{{polygon[i], polygon[i + 1], polygon[i + 2]},
                                   {polygon[i], polygon[i + 2], polygon[(i + 3) % 4]}};
  }
  return std::nullopt;
}

}  // namespace strataflow
