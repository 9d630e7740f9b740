#include "kernels/intersection/unfolded_vertices.h"

#include <array>
#include <cstdint>
#include <span>

#include "graph/parallel/parallel_map.h"
#include "kernels/adapters/cgal/exact_predicates.h"

namespace strataflow {

namespace {

constexpr std::size_t largest_fan = 32;

/// Triangles around each point: `corner[first[v]] … corner[first[v + 1] − 1]` are 3 t + k for corner k of triangle t.
struct Corners {
  std::vector<std::uint32_t> first, corner;
};

Corners corners_by_point(std::size_t point_count, const std::vector<Triangle>& triangles) {
  Corners by_point{std::vector<std::uint32_t>(point_count + 1, 0), std::vector<std::uint32_t>(3 * triangles.size())};
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) ++by_point.first[v];
  std::uint32_t end = 0;
  for (std::uint32_t& first : by_point.first) first = end += first;
  // Filled from the back: each start moves down to where it belongs.
  for (std::size_t t = triangles.size(); t-- > 0;)
    for (std::uint32_t k = 3; k-- > 0;)
      by_point.corner[--by_point.first[triangles[t][k]]] = static_cast<std::uint32_t>(3 * t) + k;
  return by_point;
}

struct Fan {
  std::array<std::uint32_t, largest_fan + 1> around;  ///< neighbours in order; the first again at the end when closed
  std::size_t size = 0;                               ///< triangles
  bool is_closed = false;
};

/// Puts the triangles around a point in order: [i] goes from neighbour from[i] to neighbour to[i]. False unless they
/// are one fan.
bool put_in_order(std::span<const std::uint32_t> from, std::span<const std::uint32_t> to, Fan& fan) {
  fan.size = from.size();
  std::size_t at = 0;
  fan.is_closed = true;
  for (std::size_t i = 0; i < fan.size && fan.is_closed; ++i) {
    bool follows = false;
    for (const std::uint32_t end : to) follows |= end == from[i];
    if (follows) continue;
    at = i;
    fan.is_closed = false;
  }
  const std::size_t start = at;
  for (std::size_t step = 0; step < fan.size; ++step) {
    fan.around[step] = from[at];
    fan.around[step + 1] = to[at];
    std::size_t next = 0;
    while (next < fan.size && from[next] != to[at]) ++next;
    // Only the last one may have none after it, or the first.
    if ((next == fan.size || next == start) != (step + 1 == fan.size)) return false;
    at = next;
  }
  return fan.is_closed == (at == start);
}

bool is_unfolded_along(const std::vector<Vec3>& points, const Vec3& apex, const Fan& fan, int axis) {
  const int s = axis == 0 ? 1 : 0, t = axis == 2 ? 1 : 2;
  const auto is_upper = [&](const Vec3& p) { return p[t] > apex[t] || (p[t] == apex[t] && p[s] > apex[s]); };
  const Vec3* before = &points[fan.around[0]];
  const bool starts_upper = is_upper(*before);
  bool was_upper = starts_upper;
  int turn = 0, changes = 0;
  for (std::size_t i = 1; i <= fan.size; ++i) {
    const Vec3* after = &points[fan.around[i]];
    const int side = orientation_2d(apex, *before, *after, axis);
    if (side == 0 || side == -turn) return false;
    turn = side;
    // Each step turns by less than half a circle, so none leaps over a half-plane.
    const bool upper = is_upper(*after);
    changes += upper != was_upper;
    was_upper = upper;
    before = after;
  }
  if (fan.is_closed) return changes == 2;
  return changes < 2 || (changes == 2 && orientation_2d(apex, *before, points[fan.around[0]], axis) == turn);
}

}  // namespace

std::vector<char> find_unfolded_vertices(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
  const Corners by_point = corners_by_point(points.size(), triangles);
  std::vector<char> is_unfolded(points.size(), 0);
  parallel_ranges(points.size(), 4096, [&](std::size_t begin, std::size_t end) {
    std::array<std::uint32_t, largest_fan> from, to;
    Fan fan;
    for (std::size_t v = begin; v < end; ++v) {
      const std::size_t count = by_point.first[v + 1] - by_point.first[v];
      if (count == 0 || count > largest_fan) continue;
      for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t corner = by_point.corner[by_point.first[v] + i], k = corner % 3;
        const Triangle& t = triangles[corner / 3];
        from[i] = t[k == 2 ? 0 : k + 1];
        to[i] = t[k == 0 ? 2 : k - 1];
      }
      if (!put_in_order({from.data(), count}, {to.data(), count}, fan)) continue;
      // Most likely along the axis nearest the normal of one of them; a crease may need another.
      const Vec3 normal = cross(points[from[0]] - points[v], points[to[0]] - points[v]);
      const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
      const int axis = x >= y ? (x >= z ? 0 : 2) : (y >= z ? 1 : 2);
      for (int turn = 0; turn < 3 && !is_unfolded[v]; ++turn)
        is_unfolded[v] = is_unfolded_along(points, points[v], fan, (axis + turn) % 3);
    }
  });
  return is_unfolded;
}

}  // namespace strataflow
