#include "kernels/hexes/gravity_field.h"

#include <array>
#include <cmath>
#include <utility>

#include "graph/parallel/parallel_map.h"
#include "kernels/hexes/conjugate_gradients.h"

namespace strataflow {
namespace {

/// Per wall, down the upright lines it has an edge on, or else those it touches, as (x, y, −1); z = 0 where it touches
/// none.
std::vector<Vec3> directions_of_lines(const LabelledTets& tets, const WallSheets& sheets) {
  const std::vector<char> is_line = find_upright_lines(tets, sheets);
  const auto down = [&](std::uint32_t edge) { return down_edge(tets, sheets.edges[edge]); };
  std::vector<Vec3> at_point(tets.points.size());
  for (std::uint32_t e = 0; e < is_line.size(); ++e)
    if (is_line[e])
      for (const std::uint32_t p : sheets.edges[e].points) at_point[p] = at_point[p] + down(e);
  return parallel_map(
      sheets.walls.size(),
      [&](std::size_t w) {
        const WallSheets::Wall& wall = sheets.walls[w];
        Vec3 sum;
        for (const std::uint32_t e : wall.edges)
          if (is_line[e]) sum = sum + down(e);
        for (std::size_t k = 0; k < 3 && sum.z == 0; ++k) sum = sum + at_point[wall.vertices[k]];
        return sum.z == 0 ? sum : (-1 / sum.z) * sum;
      },
      1024);
}

}  // namespace

std::vector<Vec3> gravity_field(const LabelledTets& tets, const WallSheets& sheets) {
  constexpr double sin_5_deg = 0.08715574274765817;
  std::vector<std::uint32_t> wall_of(tets.facets.size(), no_index);
  for (std::uint32_t w = 0; w < sheets.walls.size(); ++w) wall_of[sheets.walls[w].facet] = w;
  const std::vector<Vec3> along_line = directions_of_lines(tets, sheets);
  // Each tet's (x, y) is fixed + y_0 · axes[0] + y_1 · axes[1], with one axis where a wall holds it, none at a line.
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
      if (const Vec3& line = along_line[wall_of[tets.facet_of[4 * t + k]]]; line.z != 0) {
        free.count = 0;
        free.fixed = free.fixed + dot(line, free.axes[0]) * free.axes[0];
      }
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
  for (const Freedom& free : freedom)
    if (free.count > 0) modes.first.push_back(free.first);
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
