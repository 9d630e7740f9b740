#include "kernels/complexity/cells/voxel_grid.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

TEST(VoxelGrid, has_about_as_many_voxels_as_asked_for_and_they_are_nearly_cubes) {
  const VoxelGrid grid = cut_into_voxels({{0, 0, 0}, {1600, 930, 500}}, 10000);
  EXPECT_NEAR(grid.cell_count(), 10000, 500);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(grid.planes[axis][1] - grid.planes[axis][0], 42, 2);
  EXPECT_NEAR(grid.cell_volume_m3() * grid.cell_count(), 1600. * 930 * 500, 1e-3);
}

TEST(VoxelGrid, a_voxel_holds_its_lower_faces_and_the_last_one_its_upper_ones) {
  const VoxelGrid grid = cut_into_voxels({{0, 0, 0}, {2, 1, 1}}, 2);
  ASSERT_EQ(grid.cell_count(), 2u);
  EXPECT_EQ(grid.cell_at({0.999, 0, 0}), 0u);
  EXPECT_EQ(grid.cell_at({1, 0.5, 1}), 1u);
  EXPECT_EQ(grid.cell_at({2, 1, 1}), 1u);
  EXPECT_EQ(grid.cell_at({-5, 9, 0}), 0u);  // the nearest, for points outside
  EXPECT_EQ(grid.centre(1), (Vec3{1.5, 0.5, 0.5}));
  EXPECT_EQ(grid.cell(grid.index_of(1)), 1u);
}

}  // namespace
}  // namespace strataflow
