#include "kernels/borders/relax_ring.h"

#include <cmath>
#include <numbers>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/adapters/cgal/exact_predicates.h"

namespace strataflow {

std::vector<std::uint32_t> relax_ring(std::vector<Vec3>& points, const std::vector<Triangle>& triangles,
                                      const std::vector<std::uint32_t>& nodes, double corner_angle_deg) {
  std::vector<std::uint32_t> rank(points.size(), no_index);
  for (std::uint32_t i = 0; i < nodes.size(); ++i) rank[nodes[i]] = i;
  std::vector<std::uint32_t> first(nodes.size() + 1, 0), touched;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    bool any = false;
    for (const std::uint32_t v : triangles[t])
      if (rank[v] != no_index) {
        ++first[rank[v] + 1];
        any = true;
      }
    if (any) touched.push_back(t);
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) first[i + 1] += first[i];
  std::vector<std::uint32_t> star(first.back()), next(first.begin(), first.end() - 1);
  for (const std::uint32_t t : touched)
    for (const std::uint32_t v : triangles[t])
      if (rank[v] != no_index) star[next[rank[v]]++] = t;

  const auto normal = [&](const std::vector<Vec3>& at, const Triangle& t) {
    return cross(at[t[1]] - at[t[0]], at[t[2]] - at[t[0]]);  // twice the area long
  };
  const double flattest = std::cos(corner_angle_deg * std::numbers::pi / 180);
  std::vector<char> moves = parallel_map(
      nodes.size(),
      [&](std::size_t i) {
        Vec3 mean;
        for (std::uint32_t s = first[i]; s < first[i + 1]; ++s) mean = mean + normal(points, triangles[star[s]]);
        for (std::uint32_t s = first[i]; s < first[i + 1]; ++s) {
          const Vec3 n = normal(points, triangles[star[s]]);
          if (!(dot(n, mean) >= flattest * length(n) * length(mean))) return char{0};
        }
        return static_cast<char>(first[i] < first[i + 1]);
      },
      1024);
  std::vector<Vec3> moved = points;
  parallel_ranges(nodes.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (!moves[i]) continue;
      Vec3 sum;
      double area = 0;
      for (std::uint32_t s = first[i]; s < first[i + 1]; ++s) {
        const Triangle& t = triangles[star[s]];
        const double a = length(normal(points, t));
        sum = sum + (a / 3) * ((points[t[0]] - points[nodes[i]]) + (points[t[1]] - points[nodes[i]]) +
                               (points[t[2]] - points[nodes[i]]));
        area += a;
      }
      if (area > 0) moved[nodes[i]] = points[nodes[i]] + (1 / area) * sum;
    }
  });
  // Neighbours move at once: take back the moves around every triangle that turns over, until none does.
  for (bool any = true; any;) {
    any = false;
    for (const std::uint32_t t : touched) {
      const Triangle& v = triangles[t];
      if (dot(normal(points, v), normal(moved, v)) > 0 && projection_axis(moved[v[0]], moved[v[1]], moved[v[2]]) >= 0)
        continue;
      for (const std::uint32_t w : v) {
        if (rank[w] == no_index || !moves[rank[w]]) continue;
        moves[rank[w]] = 0;
        moved[w] = points[w];
        any = true;
      }
    }
  }
  std::vector<std::uint32_t> done;
  for (std::uint32_t v = 0; v < points.size(); ++v)
    if (rank[v] != no_index && moves[rank[v]] && !(moved[v] == points[v])) done.push_back(v);
  points = std::move(moved);
  return done;
}

}  // namespace strataflow
