#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/id.h"
#include "model/feature_mesh.h"

namespace strataflow::support {

/// Adds a feature along a path of points.
inline void add_feature(FeatureMesh& mesh, const std::string& name, const std::vector<std::uint32_t>& path) {
  const auto feature = static_cast<std::uint32_t>(mesh.features.size());
  mesh.features.push_back({name, Role::curve, 0, -1});
  for (std::size_t i = 0; i + 1 < path.size(); ++i)
    mesh.edges.push_back({std::min(path[i], path[i + 1]), std::max(path[i], path[i + 1]), feature});
  std::sort(mesh.edges.begin(), mesh.edges.end());
}

inline void add_corners(FeatureMesh& mesh, const std::vector<std::uint32_t>& points) {
  mesh.corners.insert(mesh.corners.end(), points.begin(), points.end());
  std::sort(mesh.corners.begin(), mesh.corners.end());
  mesh.corners.erase(std::unique(mesh.corners.begin(), mesh.corners.end()), mesh.corners.end());
}

/// columns × rows cells of two triangles, diagonals alternating; point (i, j) has number j · (columns + 1) + i. Cells for
/// which `keep` is false are left out (their points stay, unused). No features.
inline FeatureMesh bare_grid(std::uint32_t columns, std::uint32_t rows, const std::function<Vec3(double, double)>& place,
                             const std::function<bool(std::uint32_t, std::uint32_t)>& keep = {}) {
  FeatureMesh mesh;
  for (std::uint32_t j = 0; j <= rows; ++j)
    for (std::uint32_t i = 0; i <= columns; ++i)
      mesh.points.push_back(place(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
  const std::uint32_t width = columns + 1;
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      if (keep && !keep(i, j)) continue;
      const std::uint32_t a = j * width + i, b = a + 1, d = a + width, c = d + 1;
      if ((i + j) % 2) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
      } else {
        mesh.triangles.push_back({a, b, d});
        mesh.triangles.push_back({b, c, d});
      }
    }
  mesh.edge_length_m = 2 * length(mesh.points[1] - mesh.points[0]);
  return mesh;
}

/// Points on a straight line of a grid, both ends included.
inline std::vector<std::uint32_t> grid_path(std::uint32_t from, std::uint32_t to, std::int64_t step) {
  std::vector<std::uint32_t> path{from};
  while (path.back() != to) path.push_back(static_cast<std::uint32_t>(path.back() + step));
  return path;
}

/// A grid with its four sides as features and its four corners.
inline FeatureMesh sided_grid(std::uint32_t columns, std::uint32_t rows, const std::function<Vec3(double, double)>& place) {
  FeatureMesh mesh = bare_grid(columns, rows, place);
  const std::uint32_t width = columns + 1, last = width * rows;
  add_feature(mesh, "south", grid_path(0, columns, 1));
  add_feature(mesh, "east", grid_path(columns, last + columns, width));
  add_feature(mesh, "north", grid_path(last, last + columns, 1));
  add_feature(mesh, "west", grid_path(0, last, width));
  add_corners(mesh, {0, columns, last, last + columns});
  return mesh;
}

inline FeatureMesh square(std::uint32_t cells) {
  return sided_grid(cells, cells, [](double x, double y) { return Vec3{x, y, 0}; });
}

/// A square with a straight fault that dies out inside, along a row of the grid: from a quarter to three quarters.
inline FeatureMesh square_with_fault(std::uint32_t cells) {
  FeatureMesh mesh = square(cells);
  const std::uint32_t row = cells / 2 * (cells + 1);
  add_feature(mesh, "fault", grid_path(row + cells / 4, row + 3 * cells / 4, 1));
  add_corners(mesh, {row + cells / 4, row + 3 * cells / 4});
  return mesh;
}

/// A triangle with one corner of `angle` between two sides of length 1, in `cells` rows.
inline FeatureMesh wedge(std::uint32_t cells, double angle) {
  FeatureMesh mesh;
  const auto number = [](std::uint32_t i, std::uint32_t j) { return i * (i + 1) / 2 + j; };
  for (std::uint32_t i = 0; i <= cells; ++i)
    for (std::uint32_t j = 0; j <= i; ++j) {
      const double s = static_cast<double>(i - j) / cells, t = static_cast<double>(j) / cells;
      mesh.points.push_back({s + t * std::cos(angle), t * std::sin(angle), 0});
    }
  std::vector<std::uint32_t> lower, upper, end;
  for (std::uint32_t i = 0; i <= cells; ++i) {
    lower.push_back(number(i, 0));
    upper.push_back(number(i, i));
    end.push_back(number(cells, i));
    for (std::uint32_t j = 0; i < cells && j <= i; ++j) {
      mesh.triangles.push_back({number(i, j), number(i + 1, j), number(i + 1, j + 1)});
      if (j < i) mesh.triangles.push_back({number(i, j), number(i + 1, j + 1), number(i, j + 1)});
    }
  }
  add_feature(mesh, "lower", lower);
  add_feature(mesh, "upper", upper);
  add_feature(mesh, "end", end);
  add_corners(mesh, {0, number(cells, 0), number(cells, cells)});
  mesh.edge_length_m = 2.0 / cells;
  return mesh;
}

/// A disc of radius 1 in rings; its circle is a feature without corners.
inline FeatureMesh disc(std::uint32_t rings) {
  FeatureMesh mesh;
  mesh.points.push_back({0, 0, 0});
  const auto first = [](std::uint32_t ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
  for (std::uint32_t r = 1; r <= rings; ++r)
    for (std::uint32_t k = 0; k < 6 * r; ++k) {
      const double at = 2 * std::numbers::pi * k / (6.0 * r), radius = static_cast<double>(r) / rings;
      mesh.points.push_back({radius * std::cos(at), radius * std::sin(at), 0});
    }
  for (std::uint32_t r = 1; r <= rings; ++r)
    for (std::uint32_t side = 0; side < 6; ++side)
      for (std::uint32_t k = 0; k < r; ++k) {
        const std::uint32_t outer = first(r) + side * r + k, outer_next = first(r) + (side * r + k + 1) % (6 * r);
        const std::uint32_t rim = 6 * (r - 1);
        const std::uint32_t inner = r == 1 ? 0 : first(r - 1) + (side * (r - 1) + k) % rim;
        mesh.triangles.push_back({inner, outer, outer_next});
        if (k + 1 < r) mesh.triangles.push_back({inner, outer_next, first(r - 1) + (side * (r - 1) + k + 1) % rim});
      }
  std::vector<std::uint32_t> circle;
  for (std::uint32_t k = 0; k <= 6 * rings; ++k) circle.push_back(first(rings) + k % (6 * rings));
  add_feature(mesh, "circle", circle);
  mesh.edge_length_m = 2.0 / rings;
  return mesh;
}

/// The surface of a box, its twelve edges as features.
inline FeatureMesh box_surface(double a, double b, double c, std::uint32_t cells) {
  FeatureMesh mesh;
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> number;
  const auto at = [&](std::array<std::uint32_t, 3> p) {
    const auto [found, added] = number.try_emplace(p, static_cast<std::uint32_t>(mesh.points.size()));
    if (added) mesh.points.push_back({a * p[0] / cells, b * p[1] / cells, c * p[2] / cells});
    return found->second;
  };
  for (std::uint32_t axis = 0; axis < 3; ++axis)
    for (const std::uint32_t level : {0u, cells})
      for (std::uint32_t i = 0; i < cells; ++i)
        for (std::uint32_t j = 0; j < cells; ++j) {
          const auto corner = [&](std::uint32_t s, std::uint32_t t) {
            std::array<std::uint32_t, 3> p{};
            p[axis] = level;
            p[(axis + 1) % 3] = s;
            p[(axis + 2) % 3] = t;
            return at(p);
          };
          std::array<std::uint32_t, 4> q{corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
          if (level == 0) std::swap(q[1], q[3]);
          mesh.triangles.push_back({q[0], q[1], q[2]});
          mesh.triangles.push_back({q[0], q[2], q[3]});
        }
  for (std::uint32_t axis = 0; axis < 3; ++axis)
    for (const std::uint32_t s : {0u, cells})
      for (const std::uint32_t t : {0u, cells}) {
        std::vector<std::uint32_t> path;
        for (std::uint32_t i = 0; i <= cells; ++i) {
          std::array<std::uint32_t, 3> p{};
          p[axis] = i;
          p[(axis + 1) % 3] = s;
          p[(axis + 2) % 3] = t;
          path.push_back(at(p));
        }
        add_feature(mesh, "edge " + std::to_string(mesh.features.size()), path);
        add_corners(mesh, {path.front(), path.back()});
      }
  mesh.edge_length_m = 2 * std::max({a, b, c}) / cells;
  return mesh;
}

/// A torus of radii 2 and 1 without features.
inline FeatureMesh torus(std::uint32_t columns, std::uint32_t rows) {
  FeatureMesh mesh;
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const double u = 2 * std::numbers::pi * i / columns, v = 2 * std::numbers::pi * j / rows;
      mesh.points.push_back({(2 + std::cos(v)) * std::cos(u), (2 + std::cos(v)) * std::sin(u), std::sin(v)});
    }
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * columns + i, b = j * columns + (i + 1) % columns;
      const std::uint32_t d = (j + 1) % rows * columns + i, c = (j + 1) % rows * columns + (i + 1) % columns;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  mesh.edge_length_m = 1;
  return mesh;
}

}  // namespace strataflow::support
