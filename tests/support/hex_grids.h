#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "model/hex_grid.h"

namespace strataflow::support {

/// nx × ny quads of 100 m; those for which `is_hole` holds are left out.
inline QuadMesh plan_grid(std::uint32_t nx, std::uint32_t ny,
                          const std::function<bool(std::uint32_t, std::uint32_t)>& is_hole = {}) {
  QuadMesh plan;
  for (std::uint32_t j = 0; j <= ny; ++j)
    for (std::uint32_t i = 0; i <= nx; ++i) plan.points.push_back({100.0 * i, 100.0 * j, 0});
  for (std::uint32_t j = 0; j < ny; ++j)
    for (std::uint32_t i = 0; i < nx; ++i) {
      const std::uint32_t p = i + (nx + 1) * j;
      if (!is_hole || !is_hole(i, j)) plan.quads.push_back({p, p + 1, p + nx + 2, p + nx + 1});
    }
  return plan;
}

/// `valence` diamonds around one point, each of n × n quads; edges are about 100 m.
inline QuadMesh plan_star(std::uint32_t valence, std::uint32_t n) {
  constexpr double turn = 6.283185307179586;
  QuadMesh plan;
  std::map<std::pair<long, long>, std::uint32_t> known;
  const auto point = [&](double x, double y) {
    const auto [found, is_new] =
        known.try_emplace({std::lround(x * 1e3), std::lround(y * 1e3)}, static_cast<std::uint32_t>(plan.points.size()));
    if (is_new) plan.points.push_back({x, y, 0});
    return found->second;
  };
  for (std::uint32_t d = 0; d < valence; ++d) {
    const double a = turn * d / valence, b = turn * (d + 1) / valence;
    const auto at = [&](std::uint32_t i, std::uint32_t j) {
      return point(100 * (i * std::cos(a) + j * std::cos(b)), 100 * (i * std::sin(a) + j * std::sin(b)));
    };
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i < n; ++i)
        plan.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  }
  return plan;
}

/// Where a quad's corner lies at a level: the same point for all quads around it where nothing is offset.
using LevelPoint = std::function<Vec3(std::uint32_t quad, const Vec3& corner, std::uint32_t level)>;

/// Layers over a plan; equal points are one. Columns whose cell at a layer has no height are dead there.
/// `is_fault` says which plan edges (by their ends) lie on the fault "F1". `region_of_layer` may be empty.
inline HexGrid hex_grid(const QuadMesh& plan, std::uint32_t layers, const LevelPoint& point_at,
                        const std::function<bool(const Vec3&, const Vec3&)>& is_fault = {},
                        const std::vector<std::int32_t>& region_of_layer = {}) {
  HexGrid grid;
  grid.plan = plan;
  grid.layers = layers;
  std::map<std::tuple<double, double, double>, std::uint32_t> known;
  const auto vertex = [&](const Vec3& p) {
    const auto [found, is_new] =
        known.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(grid.mesh.points.size()));
    if (is_new) grid.mesh.points.push_back(p);
    return found->second;
  };
  grid.mesh.entities = {{"F1", Role::fault}};
  grid.mesh.surface_entity = {0};
  for (std::uint32_t q = 0; q < plan.quads.size(); ++q)
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
      std::array<std::uint32_t, 8> corners;
      double height = 0;
      for (std::uint32_t c = 0; c < 4; ++c) {
        const Vec3& corner = plan.points[plan.quads[q][c]];
        const Vec3 low = point_at(q, corner, layer), high = point_at(q, corner, layer + 1);
        corners[c] = vertex(low), corners[c + 4] = vertex(high);
        height = std::max(height, high.z - low.z);
      }
      const auto cell = static_cast<std::uint32_t>(grid.mesh.cell_count());
      grid.mesh.add_cell(CellType::hexahedron, corners.data(), region_of_layer.empty() ? 0 : region_of_layer[layer]);
      grid.cell_column.push_back(q);
      grid.cell_layer.push_back(layer);
      grid.is_dead.push_back(height <= 0);
      for (std::uint32_t s = 0; s < 4 && is_fault; ++s)
        if (is_fault(plan.points[plan.quads[q][s]], plan.points[plan.quads[q][(s + 1) % 4]]))
          grid.mesh.facets.push_back(
              {{corners[s], corners[(s + 1) % 4], corners[(s + 1) % 4 + 4], corners[s + 4]}, 0, cell, no_index});
    }
  return grid;
}

/// Level n at 10 n metres above −1000.
inline Vec3 flat_level(std::uint32_t, const Vec3& corner, std::uint32_t level) {
  return {corner.x, corner.y, -1000 + 10.0 * level};
}

/// A box of 100 m × 100 m × 10 m cells with its top layers at −1000 + 10 · layers.
inline HexGrid box_grid(std::uint32_t nx, std::uint32_t ny, std::uint32_t layers) {
  return hex_grid(plan_grid(nx, ny), layers, flat_level);
}

/// The same with the fault F1 at x = 100 · fault_i, dipping by `slope` metres in x per metre of height; everything
/// beyond it is `throw_m` lower.
inline HexGrid faulted_grid(std::uint32_t nx, std::uint32_t ny, std::uint32_t layers, std::uint32_t fault_i,
                            double throw_m, double slope = 0) {
  const double x = 100.0 * fault_i;
  const QuadMesh plan = plan_grid(nx, ny);
  return hex_grid(
      plan, layers,
      [&](std::uint32_t quad, const Vec3& corner, std::uint32_t level) {
        const double z = -1000 + 10.0 * level - (plan.points[plan.quads[quad][0]].x >= x ? throw_m : 0);
        return Vec3{corner.x + slope * (z + 1000), corner.y, z};
      },
      [&](const Vec3& a, const Vec3& b) { return a.x == x && b.x == x; });
}

}  // namespace strataflow::support
