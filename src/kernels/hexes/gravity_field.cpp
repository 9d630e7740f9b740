#include "kernels/hexes/gravity_field.h"

#include <array>
#include <cmath>

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
  constexpr double holding = 1e-9;  // where no wall says anything, straight down
  std::vector<MatrixEntry> matrix;
  std::vector<double> right(size, 0);
  for (std::uint32_t i = 0; i < size; ++i) matrix.push_back({i, i, holding});
  for (std::uint32_t face = 0; face < tets.neighbour.size(); ++face) {
    if (tets.neighbour[face] == no_index || tets.neighbour[face] < face) continue;
    const std::array<const Freedom*, 2> both{&freedom[face / 4], &freedom[tets.neighbour[face] / 4]};
    const Vec3 offset = both[0]->fixed - both[1]->fixed;
    for (std::uint32_t s = 0; s < 2; ++s)
      for (std::uint32_t i = 0; i < both[s]->count; ++i) {
        const std::uint32_t row = both[s]->first + i;
        right[row] += (s == 0 ? -1 : 1) * dot(both[s]->axes[i], offset);
        for (std::uint32_t r = 0; r < 2; ++r)
          for (std::uint32_t j = 0; j < both[r]->count; ++j) {
            const std::uint32_t column = both[r]->first + j;
            if (row < column) continue;
            const double value = (r == s ? 1 : -1) * dot(both[s]->axes[i], both[r]->axes[j]);
            if (value != 0) matrix.push_back({row, column, value});
          }
      }
  }
  std::vector<double> y(size, 0);
  conjugate_gradients(symmetric_rows(size, matrix), right, y, 1e-8, 2000);
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
