#include "kernels/complexity/cells/voxel_grid.h"

#include <algorithm>
#include <cmath>

namespace strataflow {

std::uint32_t VoxelGrid::index_along(int axis, double coordinate) const {
  const std::vector<double>& all = planes[axis];
  const auto above = std::upper_bound(all.begin() + 1, all.end() - 1, coordinate);
  return static_cast<std::uint32_t>(above - all.begin() - 1);
}

Vec3 VoxelGrid::centre(std::uint32_t cell) const {
  const std::array<std::uint32_t, 3> index = index_of(cell);
  Vec3 centre;
  for (int axis = 0; axis < 3; ++axis) centre[axis] = 0.5 * (planes[axis][index[axis]] + planes[axis][index[axis] + 1]);
  return centre;
}

double VoxelGrid::cell_volume_m3() const {
  double volume = 1;
  for (int axis = 0; axis < 3; ++axis) volume *= (planes[axis].back() - planes[axis].front()) / count(axis);
  return volume;
}

VoxelGrid cut_into_voxels(const Box3& box, std::uint32_t cells) {
  const Vec3 extent = box.high - box.low;
  const double edge_m = std::cbrt(extent.x * extent.y * extent.z / cells);
  VoxelGrid grid;
  for (int axis = 0; axis < 3; ++axis) {
    const double most = static_cast<double>(cells);
    const auto count = static_cast<std::uint32_t>(std::clamp(std::round(extent[axis] / edge_m), 1.0, most));
    for (std::uint32_t i = 0; i < count; ++i)
      grid.planes[axis].push_back(box.low[axis] + extent[axis] * (static_cast<double>(i) / count));
    grid.planes[axis].push_back(box.high[axis]);
  }
  return grid;
}

}  // namespace strataflow
