#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <vector>

#include "base/seed.h"
#include "kernels/quads/quantization/flat_mesh.h"
#include "kernels/topology/building/edge_table.h"
#include "model/corner_map.h"
#include "model/feature_mesh.h"

namespace strataflow::support {

/// A surface with a seamless map, made by hand.
struct MapShape {
  FeatureMesh mesh;
  CornerMap map;
};

inline std::vector<std::uint32_t> opposites(const FeatureMesh& mesh) {
  const EdgeTable table = build_edge_table(mesh.points.size(), mesh.triangles);
  std::vector<std::uint32_t> opposite(3 * mesh.triangles.size(), FlatMesh::outside);
  for (std::uint32_t e = 0; e < table.edge_count(); ++e)
    if (table.around(e).size() == 2) {
      opposite[table.around(e)[0]] = table.around(e)[1];
      opposite[table.around(e)[1]] = table.around(e)[0];
    }
  return opposite;
}

/// Turns from the coordinates, axes of feature edges from their nearest direction.
inline void finish_map(MapShape& shape) {
  CornerMap& map = shape.map;
  const auto opposite = opposites(shape.mesh);
  const std::size_t count = opposite.size();
  map.turns.assign(count, 0);
  map.axes.assign(count, MapAxis::none);
  map.valence.assign(shape.mesh.points.size(), 4);
  const auto along = [&](std::uint32_t h) { return map.at(FlatMesh::next(h)) - map.at(h); };
  for (std::uint32_t h = 0; h < count; ++h) {
    if (opposite[h] != FlatMesh::outside) {
      const std::complex<double> r = -along(h) / along(opposite[h]);
      map.turns[h] = static_cast<std::uint8_t>(std::lround(std::arg(r) / (M_PI / 2))) & 3;
    }
    const std::uint32_t p = shape.mesh.triangles[h / 3][h % 3], q = shape.mesh.triangles[h / 3][(h + 1) % 3];
    for (const FeatureEdge& e : shape.mesh.edges)
      if (e.a == std::min(p, q) && e.b == std::max(p, q))
        map.axes[h] = std::abs(along(h).real()) > std::abs(along(h).imag()) ? MapAxis::real : MapAxis::imaginary;
  }
}

/// Every triangle's chart turned and moved at random, or only moved.
inline void rechart(MapShape& shape, std::uint64_t seed, bool turn = true) {
  RandomStream random(seed);
  for (std::size_t t = 0; t < shape.mesh.triangles.size(); ++t) {
    const int turns = turn ? static_cast<int>(random.below(4)) : 0;
    const std::complex<double> move{10 * random.unit() - 5, 10 * random.unit() - 5};
    for (std::size_t c = 3 * t; c < 3 * t + 3; ++c) {
      const auto z = turned(shape.map.at(static_cast<std::uint32_t>(c)), turns) + move;
      shape.map.uv[c] = {z.real(), z.imag()};
    }
  }
  finish_map(shape);
}

/// The surface of a box: 12 triangles, eight cone points of three quarters, a random chart per triangle.
inline MapShape box_map(double a, double b, double c, std::uint64_t seed) {
  MapShape shape;
  for (int k = 0; k < 8; ++k) shape.mesh.points.push_back({k & 1 ? a : 0, k & 2 ? b : 0, k & 4 ? c : 0});
  const std::array<std::array<std::uint32_t, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& f : faces) {
    const double w = length(shape.mesh.points[f[1]] - shape.mesh.points[f[0]]);
    const double h = length(shape.mesh.points[f[2]] - shape.mesh.points[f[1]]);
    shape.mesh.triangles.push_back({f[0], f[1], f[2]});
    shape.mesh.triangles.push_back({f[0], f[2], f[3]});
    shape.map.uv.insert(shape.map.uv.end(), {{0, 0}, {w, 0}, {w, h}, {0, 0}, {w, h}, {0, h}});
  }
  rechart(shape, seed);
  return shape;
}

/// The closed surface of n × n columns whose heights are sums of a row's and a column's whole number, planes of the
/// grid at random distances in [0.3, 3.3]: many cone points of three, five and six quarters.
inline MapShape terrain_map(int n, std::uint64_t seed) {
  MapShape shape;
  RandomStream random(seed);
  std::vector<int> row, column;
  for (int k = 0; k < n; ++k) {
    row.push_back(1 + static_cast<int>(random.below(3)));
    column.push_back(static_cast<int>(random.below(3)));
  }
  std::array<std::vector<double>, 3> plane;
  for (auto& list : plane) {
    list.push_back(0);
    for (int k = 0; k < std::max(n, 5); ++k) list.push_back(list.back() + 0.3 + 3 * random.unit());
  }
  const int side = n + 1;
  std::vector<std::uint32_t> point(static_cast<std::size_t>(side * side * 6), 0xFFFFFFFFu);
  const auto at = [&](int i, int j, int k) {
    std::uint32_t& p = point[static_cast<std::size_t>((k * side + j) * side + i)];
    if (p == 0xFFFFFFFFu) {
      p = static_cast<std::uint32_t>(shape.mesh.points.size());
      shape.mesh.points.push_back({plane[0][static_cast<std::size_t>(i)], plane[1][static_cast<std::size_t>(j)],
                                   plane[2][static_cast<std::size_t>(k)]});
    }
    return p;
  };
  const auto add = [&](std::array<std::uint32_t, 4> f) {
    const double w = length(shape.mesh.points[f[1]] - shape.mesh.points[f[0]]);
    const double h = length(shape.mesh.points[f[2]] - shape.mesh.points[f[1]]);
    shape.mesh.triangles.push_back({f[0], f[1], f[2]});
    shape.mesh.triangles.push_back({f[0], f[2], f[3]});
    shape.map.uv.insert(shape.map.uv.end(), {{0, 0}, {w, 0}, {w, h}, {0, 0}, {w, h}, {0, h}});
  };
  const auto height = [&](int i, int j) {
    return i < 0 || j < 0 || i >= n || j >= n ? 0
                                              : row[static_cast<std::size_t>(i)] + column[static_cast<std::size_t>(j)];
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int h = height(i, j);
      add({at(i, j, h), at(i + 1, j, h), at(i + 1, j + 1, h), at(i, j + 1, h)});
      add({at(i, j, 0), at(i, j + 1, 0), at(i + 1, j + 1, 0), at(i + 1, j, 0)});
      for (int k = 0; k < h; ++k) {
        if (k >= height(i - 1, j)) add({at(i, j, k), at(i, j, k + 1), at(i, j + 1, k + 1), at(i, j + 1, k)});
        if (k >= height(i + 1, j))
          add({at(i + 1, j, k), at(i + 1, j + 1, k), at(i + 1, j + 1, k + 1), at(i + 1, j, k + 1)});
        if (k >= height(i, j - 1)) add({at(i, j, k), at(i + 1, j, k), at(i + 1, j, k + 1), at(i, j, k + 1)});
        if (k >= height(i, j + 1))
          add({at(i, j + 1, k), at(i, j + 1, k + 1), at(i + 1, j + 1, k + 1), at(i + 1, j + 1, k)});
      }
    }
  rechart(shape, seed);
  return shape;
}

/// Splits random triangles at random inner points.
inline void insert_points(MapShape& shape, int count, std::uint64_t seed) {
  RandomStream random(seed);
  for (int k = 0; k < count; ++k) {
    const std::size_t t = random.below(shape.mesh.triangles.size());
    double a = 0.1 + random.unit(), b = 0.1 + random.unit(), c = 0.1 + random.unit();
    const double sum = a + b + c;
    a /= sum, b /= sum, c /= sum;
    const Triangle old = shape.mesh.triangles[t];
    const auto p = static_cast<std::uint32_t>(shape.mesh.points.size());
    const auto& x = shape.mesh.points;
    shape.mesh.points.push_back(a * x[old[0]] + b * x[old[1]] + c * x[old[2]]);
    const std::array<std::array<double, 2>, 3> uv{shape.map.uv[3 * t], shape.map.uv[3 * t + 1],
                                                  shape.map.uv[3 * t + 2]};
    const std::array<double, 2> centre{a * uv[0][0] + b * uv[1][0] + c * uv[2][0],
                                       a * uv[0][1] + b * uv[1][1] + c * uv[2][1]};
    shape.mesh.triangles[t] = {old[0], old[1], p};
    shape.map.uv[3 * t + 2] = centre;
    shape.mesh.triangles.push_back({old[1], old[2], p});
    shape.map.uv.insert(shape.map.uv.end(), {uv[1], uv[2], centre});
    shape.mesh.triangles.push_back({old[2], old[0], p});
    shape.map.uv.insert(shape.map.uv.end(), {uv[2], uv[0], centre});
  }
  finish_map(shape);
}

/// A w × h rectangle of nx × ny cells, two triangles each, its sides the features south, east, north, west unless
/// `is_free`. Points row by row from the south-west.
inline MapShape rectangle_map(double w, double h, int nx, int ny, bool is_free = false) {
  MapShape shape;
  FeatureMesh& mesh = shape.mesh;
  const auto at = [nx](int i, int j) { return static_cast<std::uint32_t>(j * (nx + 1) + i); };
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) mesh.points.push_back({w * i / nx, h * j / ny, 0});
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t p : t) shape.map.uv.push_back({mesh.points[p].x, mesh.points[p].y});
  if (!is_free) {
    for (const char* name : {"south", "east", "north", "west"}) mesh.features.push_back({name, Role::curve, 0, -1});
    for (int i = 0; i < nx; ++i) {
      mesh.edges.push_back({at(i, 0), at(i + 1, 0), 0});
      mesh.edges.push_back({at(i, ny), at(i + 1, ny), 2});
    }
    for (int j = 0; j < ny; ++j) {
      mesh.edges.push_back({at(0, j), at(0, j + 1), 3});
      mesh.edges.push_back({at(nx, j), at(nx, j + 1), 1});
    }
    mesh.corners = {at(0, 0), at(nx, 0), at(0, ny), at(nx, ny)};
  }
  return shape;
}

/// Adds a feature along a chain of points; its two ends become corners unless it is closed.
inline void add_feature(MapShape& shape, const std::vector<std::uint32_t>& chain, const char* name) {
  const auto feature = static_cast<std::uint32_t>(shape.mesh.features.size());
  shape.mesh.features.push_back({name, Role::curve, 0, -1});
  for (std::size_t k = 0; k + 1 < chain.size(); ++k)
    shape.mesh.edges.push_back({std::min(chain[k], chain[k + 1]), std::max(chain[k], chain[k + 1]), feature});
  if (chain.front() != chain.back()) {
    shape.mesh.corners.push_back(chain.front());
    shape.mesh.corners.push_back(chain.back());
  }
}

/// Moves a point of a plane map whose charts are all the plane itself.
inline void move_point(MapShape& shape, std::uint32_t p, double x, double y) {
  shape.mesh.points[p] = {x, y, 0};
  for (std::size_t c = 0; c < shape.map.uv.size(); ++c)
    if (shape.mesh.triangles[c / 3][c % 3] == p) shape.map.uv[c] = {x, y};
}

/// Sorts what was added and computes turns and axes.
inline void finish_shape(MapShape& shape) {
  auto& edges = shape.mesh.edges;
  std::sort(edges.begin(), edges.end());
  auto& corners = shape.mesh.corners;
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  finish_map(shape);
}

/// A cylinder w around and h high, of nx × ny cells (nx at least 3): no corner, its two rims the closed features south
/// and north. Points row by row; the first column's charts meet the last one's with a jump of w.
inline MapShape cylinder_map(double w, double h, int nx, int ny) {
  MapShape shape;
  const auto at = [=](int i, int j) { return static_cast<std::uint32_t>(j * nx + i % nx); };
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i < nx; ++i)
      shape.mesh.points.push_back({std::cos(2 * M_PI * i / nx) * w, std::sin(2 * M_PI * i / nx) * w, h * j / ny});
  const double dx = w / nx, dy = h / ny;
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const double x = dx * i, y = dy * j;
      shape.mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      shape.mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      shape.map.uv.insert(shape.map.uv.end(),
                          {{x, y}, {x + dx, y}, {x + dx, y + dy}, {x, y}, {x + dx, y + dy}, {x, y + dy}});
    }
  std::vector<std::uint32_t> south, north;
  for (int i = 0; i <= nx; ++i) {
    south.push_back(at(i, 0));
    north.push_back(at(i, ny));
  }
  add_feature(shape, south, "south");
  add_feature(shape, north, "north");
  return shape;
}

/// A flat torus with periods w and h, of nx × ny cells (at least 3 each).
inline MapShape torus_map(double w, double h, int nx, int ny) {
  MapShape shape;
  const auto at = [=](int i, int j) { return static_cast<std::uint32_t>((j % ny) * nx + i % nx); };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const double s = 2 * M_PI * i / nx, t = 2 * M_PI * j / ny;
      shape.mesh.points.push_back({(3 + std::cos(t)) * std::cos(s), (3 + std::cos(t)) * std::sin(s), std::sin(t)});
    }
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const double x = w * i / nx, y = h * j / ny, dx = w / nx, dy = h / ny;
      shape.mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      shape.mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      shape.map.uv.insert(shape.map.uv.end(),
                          {{x, y}, {x + dx, y}, {x + dx, y + dy}, {x, y}, {x + dx, y + dy}, {x, y + dy}});
    }
  finish_map(shape);
  return shape;
}

}  // namespace strataflow::support
