#include "kernels/intersection/unfolded_vertices.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/adapters/cgal/exact_predicates.h"

namespace strataflow {

namespace {

constexpr std::size_t largest_fan = 32;

/// Triangles by the stretch of point numbers they reach over: few chunks of neighbours have to do with a range of
/// points. In the worst order every range reads them all, so there are few ranges, whatever the size.
class TrianglesByPoint {
 public:
  explicit TrianglesByPoint(const std::vector<Triangle>& triangles) : triangles_(triangles) {
    reach_ = parallel_map((triangles.size() + chunk_size - 1) / chunk_size, [&](std::size_t chunk) {
      std::array<std::uint32_t, 2> reach{no_index, 0};
      for (std::size_t t = chunk * chunk_size; t < end_of(chunk); ++t)
        for (const std::uint32_t v : triangles[t]) reach = {std::min(reach[0], v), std::max(reach[1], v)};
      return reach;
    });
  }

  /// Calls visit(v, 3 t + k) for every corner k of a triangle t at a point begin ≤ v < end, ascending.
  template <class Visit>
  void visit_corners(std::size_t begin, std::size_t end, Visit&& visit) const {
    for (std::size_t chunk = 0; chunk < reach_.size(); ++chunk) {
      if (reach_[chunk][1] < begin || reach_[chunk][0] >= end) continue;
      for (std::size_t t = chunk * chunk_size; t < end_of(chunk); ++t)
        for (std::uint32_t k = 0; k < 3; ++k)
          if (const std::uint32_t v = triangles_[t][k]; v >= begin && v < end)
            visit(v, static_cast<std::uint32_t>(3 * t) + k);
    }
  }

 private:
  static constexpr std::size_t chunk_size = 2048;
  std::size_t end_of(std::size_t chunk) const { return std::min(triangles_.size(), (chunk + 1) * chunk_size); }

  const std::vector<Triangle>& triangles_;
  std::vector<std::array<std::uint32_t, 2>> reach_;  ///< per chunk: least and greatest point
};

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
  const TrianglesByPoint by_point(triangles);
  std::vector<char> is_unfolded(points.size(), 0);
  parallel_ranges(points.size(), std::max<std::size_t>(4096, points.size() / 24),
                  [&](std::size_t begin, std::size_t end) {
                    std::vector<std::uint32_t> last(end - begin, 0);  // per point the end of its corners
                    by_point.visit_corners(begin, end, [&](std::size_t v, std::uint32_t) { ++last[v - begin]; });
                    std::uint32_t sum = 0;
                    for (std::uint32_t& place : last) sum += std::exchange(place, sum);
                    std::vector<std::uint32_t> corners(sum);
                    by_point.visit_corners(
                        begin, end, [&](std::size_t v, std::uint32_t corner) { corners[last[v - begin]++] = corner; });
                    std::array<std::uint32_t, largest_fan> from, to;
                    Fan fan;
                    for (std::size_t v = begin; v < end; ++v) {
                      const std::uint32_t first = v == begin ? 0 : last[v - begin - 1], count = last[v - begin] - first;
                      if (count == 0 || count > largest_fan) continue;
                      for (std::size_t i = 0; i < count; ++i) {
                        const std::uint32_t corner = corners[first + i], k = corner % 3;
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
