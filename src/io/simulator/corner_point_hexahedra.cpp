#include "io/simulator/corner_point_hexahedra.h"

#include <algorithm>
#include <numeric>
#include <string>
#include <utility>

namespace strataflow {

namespace {
/// Six times the volume of the tetrahedra around a cell's diagonal: enough to tell its sign.
double signed_size(const std::array<Vec3, 8>& p) {
  static constexpr int around[] = {1, 2, 3, 7, 4, 5, 1};
  double size = 0;
  for (int n = 0; n < 6; ++n) size += dot(p[6] - p[0], cross(p[around[n]] - p[0], p[around[n + 1]] - p[0]));
  return size;
}
}  // namespace

InputData hexahedra_of(const CornerPointGrid& grid, const std::vector<std::int32_t>& layer_region) {
  InputData data;
  std::vector<std::array<Vec3, 8>> cells;
  std::vector<std::int32_t> regions;
  std::size_t without_height = 0, nowhere = 0;
  double size = 0;
  for (std::size_t cell = 0; cell < grid.cell_count(); ++cell) {
    if (!grid.is_active[cell]) continue;
    const auto corners = grid.corners_of(cell);
    if (!std::all_of(corners.begin(), corners.end(), is_finite)) {
      ++nowhere;
      continue;
    }
    bool has_height = false;
    for (int c = 0; c < 4; ++c) has_height = has_height || corners[c].z != corners[c + 4].z;
    if (!has_height) {
      ++without_height;
      continue;
    }
    cells.push_back(corners);
    const std::uint32_t k = grid.indices(cell)[2];
    regions.push_back(k < layer_region.size() ? layer_region[k] : 0);
    size += signed_size(corners);
  }
  if (size < 0)
    for (auto& corners : cells) {
      std::swap(corners[1], corners[3]);
      std::swap(corners[5], corners[7]);
    }

  std::vector<std::uint64_t> order(8 * cells.size());
  std::iota(order.begin(), order.end(), std::uint64_t{0});
  const auto corner = [&](std::uint64_t n) -> const Vec3& { return cells[n / 8][n % 8]; };
  std::sort(order.begin(), order.end(), [&](std::uint64_t a, std::uint64_t b) {
    return corner(a) == corner(b) ? a < b : lexicographically_less(corner(a), corner(b));
  });
  std::vector<std::uint32_t> point_of(order.size());
  VolumeMesh& mesh = data.volume;
  for (std::size_t n = 0; n < order.size(); ++n) {
    if (n == 0 || !(corner(order[n]) == corner(order[n - 1])))
      mesh.points.push_back(corner(order[n]) + grid.local_origin);
    point_of[order[n]] = static_cast<std::uint32_t>(mesh.points.size() - 1);
  }
  for (std::size_t c = 0; c < cells.size(); ++c) mesh.add_cell(CellType::hexahedron, &point_of[8 * c], regions[c]);
  if (without_height > 0)
    data.warnings.push_back({"cells_without_height", std::to_string(without_height) + " active cells have no height"});
  if (nowhere > 0)
    data.warnings.push_back({"cells_nowhere", std::to_string(nowhere) + " cells have a corner far off a flat pillar"});
  return data;
}

}  // namespace strataflow
