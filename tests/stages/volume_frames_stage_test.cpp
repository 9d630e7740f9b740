#include "stages/volume_frames_stage.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

/// The corner tetrahedron of a cube: three sides at right angles.
VolumeMesh corner() {
  VolumeMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::uint32_t vertices[]{0, 1, 2, 3};
  mesh.add_cell(CellType::tetrahedron, vertices, 0);
  return mesh;
}

TEST(VolumeFramesStage, gives_three_directions_to_every_cell) {
  StageContext context;
  const Result<FramedMesh> framed = FindVolumeFrames{}(corner(), context);
  ASSERT_TRUE(framed) << describe(framed.failure());
  ASSERT_EQ(framed->directions.size(), 3u);
  for (const CellField& field : framed->directions) {
    ASSERT_EQ(field.values.size(), 3u);
    EXPECT_NEAR(std::hypot(field.values[0], field.values[1], field.values[2]), 1, 1e-12);
  }
  EXPECT_TRUE(framed->singular.empty());
  EXPECT_GT(framed->smallest_determinant, 0);
}

TEST(VolumeFramesStage, is_for_tetrahedra) {
  StageContext context;
  VolumeMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::uint32_t vertices[]{0, 1, 2, 3, 4};
  mesh.add_cell(CellType::pyramid, vertices, 0);
  EXPECT_FALSE(FindVolumeFrames{}(mesh, context));
}

}  // namespace
}  // namespace strataflow
