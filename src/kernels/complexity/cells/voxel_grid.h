#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "model/box3.h"

namespace strataflow {

/// A box cut into equal voxels, x fastest. A voxel holds its lower faces, and the last one its upper faces too.
struct VoxelGrid {
  std::array<std::vector<double>, 3> planes;  ///< per axis, ascending: one more than there are voxels

  std::uint32_t count(int axis) const { return static_cast<std::uint32_t>(planes[axis].size() - 1); }
  std::uint32_t cell_count() const { return count(0) * count(1) * count(2); }
  std::uint32_t cell(const std::array<std::uint32_t, 3>& index) const {
    return (index[2] * count(1) + index[1]) * count(0) + index[0];
  }
  std::array<std::uint32_t, 3> index_of(std::uint32_t cell) const {
    return {cell % count(0), cell / count(0) % count(1), cell / count(0) / count(1)};
  }
  /// Of the voxel nearest to the coordinate, for points outside.
  std::uint32_t index_along(int axis, double coordinate) const;
  std::uint32_t cell_at(const Vec3& p) const {
    return cell({index_along(0, p.x), index_along(1, p.y), index_along(2, p.z)});
  }
  Vec3 centre(std::uint32_t cell) const;
  double cell_volume_m3() const;
};

/// About `cells` voxels, as near to cubes as whole numbers allow. Needs a box with room inside and 1 ≤ cells ≤ 10⁸.
VoxelGrid cut_into_voxels(const Box3& box, std::uint32_t cells);

}  // namespace strataflow
