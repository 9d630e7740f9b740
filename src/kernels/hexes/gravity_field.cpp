#include "kernels/hexes/gravity_field.h"

#include <array>
#include <cmath>
#include <utility>

#include "graph/parallel/parallel_map.h"
#include "kernels/hexes/conjugate_gradients.h"

namespace strataflow {

std::vector<Vec3> gravity_field(const LabelledTets& tets) {
  constexpr double sin_5_deg = 0.08715574274765817;
  // Each tet's (x, y) is fixed + y_0 · axes[0] + y_1 · axes[1], with one axis where a wall holds it.
  struct Freedom {
    std::uint32_t first = 0, count = 2;
    Vec3 fixed;
    std::array<Vec3, 2> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}};
  };
  std::vector<Freedom> freedom(tets.tets.size());
  std::uint32_t size = 0;
  for (std::uint32_t t = 0; t < tets.tets.size(); ++t) {
    Freedom& free = freedom[t];
    for (std::uint32_t k = 0; k < 4 && free.count == 2; ++k) {
      if (!tets.is_wall(4 * t + k)) continue;
      // From one order of the corners, so that both sides of a wall have the same numbers.
      const Triangle& v = tets.facets[tets.facet_of[4 * t + k]].vertices;
      Vec3 n = cross(tets.points[v[1]] - tets.points[v[0]], tets.points[v[2]] - tets.points[v[0]]);
      n = (1 / length(n)) * n;
      const double flat = std::hypot(n.x, n.y);
      if (!(flat > sin_5_deg)) continue;
      free.count = 1;
      free.fixed = {n.x / flat * (n.z / flat), n.y / flat * (n.z / flat), 0};
      free.axes[0] = {-n.y / flat, n.x / flat, 0};
    }
    free.first = size;
    size += free.count;
  }
  // (2.3) row by row: what is the same on both sides of a face costs nothing.
  constexpr double holding = 1e-9;  // where no wall says anything, straight down
  SparseRows matrix;
  matrix.first.assign(size + 1, 0);
  const auto others_of = [&](std::uint32_t t, auto&& visit) {
    for (std::uint32_t face = 4 * t; face < 4 * t + 4; ++face)
      if (tets.neighbour[face] != no_index) visit(freedom[tets.neighbour[face] / 4]);
  };
  parallel_ranges(freedom.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t)
      for (std::uint32_t i = 0; i < freedom[t].count; ++i) {
        std::uint32_t& count = matrix.first[freedom[t].first + i + 1];
        count = 1;
        others_of(static_cast<std::uint32_t>(t), [&](const Freedom& other) {
          for (std::uint32_t j = 0; j < other.count; ++j) count += dot(freedom[t].axes[i], other.axes[j]) != 0 ? 1 : 0;
        });
      }
  });
  for (std::uint32_t i = 0; i < size; ++i) matrix.first[i + 1] += matrix.first[i];
  matrix.columns.resize(matrix.first.back());
  matrix.values.resize(matrix.first.back());
  std::vector<double> right(size, 0);
  SoftModes modes{{}, std::vector<std::array<double, 2>>(size), 2};
  for (const Freedom& free : freedom) modes.first.push_back(free.first);
  modes.first.push_back(size);
  parallel_ranges(freedom.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const Freedom& free = freedom[t];
      for (std::uint32_t i = 0; i < free.count; ++i) {
        const std::uint32_t row = free.first + i;
        std::uint32_t at = matrix.first[row];
        matrix.columns[at] = row;
        double& diagonal = matrix.values[at++] = holding;
        others_of(static_cast<std::uint32_t>(t), [&](const Freedom& other) {
          diagonal += 1;
          right[row] += dot(free.axes[i], other.fixed - free.fixed);
          for (std::uint32_t j = 0; j < other.count; ++j) {
            const double value = dot(free.axes[i], other.axes[j]);
            if (value == 0) continue;
            matrix.columns[at] = other.first + j;
            matrix.values[at++] = -value;
          }
        });
        modes.of_unknown[row] = {free.axes[i].x, free.axes[i].y};
      }
    }
  });
  std::vector<double> y(size, 0);
  conjugate_gradients(Multigrid(std::move(matrix), std::move(modes)), right, y, 1e-8, 2000);
  std::vector<Vec3> field;
  field.reserve(freedom.size());
  for (const Freedom& free : freedom) {
    Vec3 g = free.fixed;
    for (std::uint32_t i = 0; i < free.count; ++i) g = g + y[free.first + i] * free.axes[i];
    g.z = -1;
    field.push_back(g);
  }
  return field;
}

}  // namespace strataflow
