#include "kernels/reference_models/sheet_soup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace strataflow {

void SheetSoup::add_grid(std::uint32_t entity, std::uint32_t columns, std::uint32_t rows,
                         const std::function<Vec3(std::uint32_t, std::uint32_t)>& point) {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  points.reserve(std::size_t{columns} * rows);
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) points.push_back(point(i, j));
  for (std::uint32_t j = 0; j + 1 < rows; ++j) {
    for (std::uint32_t i = 0; i + 1 < columns; ++i) {
      const std::uint32_t a = j * columns + i, b = a + 1, c = b + columns, d = a + columns;
      triangles.push_back({a, b, c});
      triangles.push_back({a, c, d});
    }
  }
  add_sheet(entity, points, triangles);
}

void SheetSoup::add_sheet(std::uint32_t entity, const std::vector<Vec3>& points,
                          const std::vector<Triangle>& triangles) {
  constexpr std::uint32_t unused = 0xffffffffu;
  std::vector<std::uint32_t> number(points.size(), unused);
  for (const Triangle& triangle : triangles)
    for (const std::uint32_t p : triangle) number[p] = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    if (number[p] == unused) continue;
    number[p] = static_cast<std::uint32_t>(soup_.points.size());
    soup_.points.push_back(points[p]);
  }
  for (const Triangle& t : triangles) soup_.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
  soup_.triangle_patch.resize(soup_.triangles.size(), static_cast<std::uint32_t>(soup_.patch_entity.size()));
  soup_.patch_entity.push_back(entity);
}

void SheetSoup::add_clipped_sheet(std::uint32_t entity, std::vector<Vec3> points,
                                  const std::vector<Triangle>& triangles, std::vector<double> clearance) {
  std::vector<std::pair<std::array<std::uint32_t, 2>, std::uint32_t>> cuts;  // edge of two points -> its new point
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const Triangle& t : triangles)
    for (std::size_t k = 0; k < 3; ++k)
      if ((clearance[t[k]] >= 0) != (clearance[t[(k + 1) % 3]] >= 0))
        edges.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const auto& [a, b] : edges) {
    const double share = clearance[a] / (clearance[a] - clearance[b]);
    cuts.push_back({{a, b}, static_cast<std::uint32_t>(points.size())});
    points.push_back(points[a] + share * (points[b] - points[a]));
  }
  const auto cut = [&](std::uint32_t a, std::uint32_t b) {
    const std::array<std::uint32_t, 2> edge{std::min(a, b), std::max(a, b)};
    return std::lower_bound(cuts.begin(), cuts.end(), edge,
                            [](const auto& c, const std::array<std::uint32_t, 2>& e) { return c.first < e; })
        ->second;
  };
  std::vector<Triangle> kept;
  for (const Triangle& t : triangles) {
    std::vector<std::uint32_t> polygon;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (clearance[a] >= 0) polygon.push_back(a);
      if ((clearance[a] >= 0) != (clearance[b] >= 0)) polygon.push_back(cut(a, b));
    }
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      const Vec3 &p = points[polygon[0]], &q = points[polygon[k - 1]], &r = points[polygon[k]];
      if (length(cross(q - p, r - p)) > 0) kept.push_back({polygon[0], polygon[k - 1], polygon[k]});
    }
  }
  add_sheet(entity, points, kept);
}

void SheetSoup::add_box_sides(std::uint32_t top, const Vec3& low, const Vec3& high, double edge_m) {
  std::array<std::uint32_t, 3> count{};
  for (int axis = 0; axis < 3; ++axis)
    count[static_cast<std::size_t>(axis)] =
        static_cast<std::uint32_t>(std::max(1.0, std::round((high[axis] - low[axis]) / edge_m)));
  const auto along = [&](int axis, std::uint32_t i) {
    const std::uint32_t n = count[static_cast<std::size_t>(axis)];
    return i == n ? high[axis] : low[axis] + (high[axis] - low[axis]) * (double(i) / n);
  };
  const auto side = [&](std::uint32_t entity, int fixed, double value, int u, int v) {
    add_grid(entity, count[static_cast<std::size_t>(u)] + 1, count[static_cast<std::size_t>(v)] + 1,
             [&](std::uint32_t i, std::uint32_t j) {
               Vec3 p;
               p[fixed] = value;
               p[u] = along(u, i);
               p[v] = along(v, j);
               return p;
             });
  };
  side(top, 2, high.z, 0, 1);
  side(top + 1, 2, low.z, 0, 1);
  side(top + 2, 1, high.y, 0, 2);
  side(top + 3, 1, low.y, 0, 2);
  side(top + 4, 0, high.x, 1, 2);
  side(top + 5, 0, low.x, 1, 2);
}

TriangleSoup SheetSoup::take_welded() {
  std::vector<std::uint32_t> order(soup_.points.size()), number(soup_.points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    if (soup_.points[a] == soup_.points[b]) return a < b;
    return lexicographically_less(soup_.points[a], soup_.points[b]);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_repeat = i > 0 && soup_.points[order[i]] == soup_.points[order[i - 1]];
    number[order[i]] = is_repeat ? number[order[i - 1]] : order[i];
  }
  for (Triangle& triangle : soup_.triangles)
    for (std::uint32_t& p : triangle) p = number[p];
  std::vector<Vec3> kept;
  for (std::uint32_t p = 0; p < number.size(); ++p) {  // a repeat has the number of a point before it
    if (number[p] == p) {
      number[p] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(soup_.points[p]);
    } else {
      number[p] = number[number[p]];
    }
  }
  for (Triangle& triangle : soup_.triangles)
    for (std::uint32_t& p : triangle) p = number[p];
  soup_.points = std::move(kept);
  return take();
}

}  // namespace strataflow
