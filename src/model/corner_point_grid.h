#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "model/vector3.h"

namespace strataflow {

/// A grid as reservoir simulators know it: columns of cells between straight lines, the pillars; each cell has a height
/// of its own at each of its eight corners. Here z points up as everywhere; files count depth. I and J with upward z
/// turn counter-clockwise, K counts from the top.
struct CornerPointGrid {
  Vec3 local_origin;
  std::array<std::uint32_t, 3> size{};  ///< cells along I, J, K
  std::vector<Vec3> pillars;            ///< an upper and a lower point per pillar, I fastest: 2 (I + 1)(J + 1)
  std::vector<double> corner_z;         ///< 8 per cell, in the order of ZCORN; metres
  std::vector<std::uint8_t> is_active;  ///< per cell, I fastest, then J, then K

  std::size_t cell_count() const { return std::size_t{size[0]} * size[1] * size[2]; }
  std::size_t cell(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
    return i + std::size_t{size[0]} * (j + std::size_t{size[1]} * k);
  }
  std::array<std::uint32_t, 3> indices(std::size_t cell) const {
    return {static_cast<std::uint32_t>(cell % size[0]), static_cast<std::uint32_t>(cell / size[0] % size[1]),
            static_cast<std::uint32_t>(cell / size[0] / size[1])};
  }
  std::size_t pillar(std::uint32_t i, std::uint32_t j) const { return i + std::size_t{size[0] + 1} * j; }
  /// Place in `corner_z` of the corner (di, dj, dk) of a cell; dk is 0 at its top.
  std::size_t corner(const std::array<std::uint32_t, 3>& cell, std::uint32_t di, std::uint32_t dj,
                     std::uint32_t dk) const {
    return (2 * cell[0] + di) +
           2 * std::size_t{size[0]} * ((2 * cell[1] + dj) + 2 * std::size_t{size[1]} * (2 * cell[2] + dk));
  }
  /// The point of a pillar at height z; of a pillar without height, its upper point.
  Vec3 point_on(std::size_t pillar, double z) const {
    const Vec3 &upper = pillars[2 * pillar], &lower = pillars[2 * pillar + 1];
    const double height = upper.z - lower.z;
    const double t = height != 0 ? (upper.z - z) / height : 0;
    return {upper.x + t * (lower.x - upper.x), upper.y + t * (lower.y - upper.y), z};
  }
  /// The corners of a cell in the order of VTK: four at the bottom, counter-clockwise seen from above, four above them.
  std::array<Vec3, 8> corners_of(std::size_t cell_index) const {
    static constexpr std::uint32_t di[] = {0, 1, 1, 0}, dj[] = {0, 0, 1, 1};
    const auto ijk = indices(cell_index);
    std::array<Vec3, 8> points;
    for (std::uint32_t v = 0; v < 8; ++v) {
      const std::uint32_t i = di[v % 4], j = dj[v % 4];
      points[v] = point_on(pillar(ijk[0] + i, ijk[1] + j), corner_z[corner(ijk, i, j, v < 4 ? 1 : 0)]);
    }
    return points;
  }
  template <class A>
  void archive(A& a) {
    a(local_origin, size, pillars, corner_z, is_active);
  }
};

}  // namespace strataflow
