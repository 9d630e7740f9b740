#include "kernels/complexity/cells/voronoi_pieces.h"

#include <gtest/gtest.h>

#include "kernels/complexity/cells/voxel_pieces.h"
#include "kernels/complexity/models.h"

namespace strataflow {
namespace {

CellPieces cut(const StructuralModel& model, const std::vector<Vec3>& sites) {
  SiteNeighbours neighbours(SiteNeighbours::in_volumes);
  neighbours.move_to(sites);
  return cut_by_voronoi(model, build_edge_table(model.points.size(), model.triangles), neighbours);
}

TEST(VoronoiPieces, of_sites_in_the_middle_of_voxels_are_those_of_the_voxels) {
  const StructuralModel model = reference_model("A3", 100);
  VoxelGrid grid;  // cubes, off the model's own coordinates
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i <= (axis == 0 ? 13 : axis == 1 ? 8 : 5); ++i) grid.planes[axis].push_back(-7.3 + 129 * i);
  const CellPieces voxels = cut_by_voxels(model, grid), cells = cut(model, voxels.sites);
  for (std::size_t c = 0; c < voxels.cell_count(); ++c) {
    double area_m2 = 0, line_m = 0;
    for (const SurfacePiece& piece : voxels.surfaces_in(c)) area_m2 += piece.area_m2;
    for (const SurfacePiece& piece : cells.surfaces_in(c)) area_m2 -= piece.area_m2;
    for (const LinePiece& piece : voxels.lines_in(c)) line_m += piece.length_m;
    for (const LinePiece& piece : cells.lines_in(c)) line_m -= piece.length_m;
    EXPECT_NEAR(area_m2, 0, 1e-6) << c;
    EXPECT_NEAR(line_m, 0, 1e-8) << c;
    EXPECT_EQ(voxels.corners_in(c).size(), cells.corners_in(c).size());
    ASSERT_EQ(voxels.surfaces_in(c).size(), cells.surfaces_in(c).size()) << c;
    for (std::size_t i = 0; i < voxels.surfaces_in(c).size(); ++i) {
      EXPECT_EQ(voxels.surfaces_in(c)[i].triangle, cells.surfaces_in(c)[i].triangle);
      EXPECT_EQ(voxels.surfaces_in(c)[i].edges, cells.surfaces_in(c)[i].edges);
    }
  }
}

TEST(SpreadInBox, fills_the_box_evenly_and_the_same_for_the_same_seed) {
  const Box3 box{{0, 0, 0}, {4, 2, 1}};
  const std::vector<Vec3> sites = spread_in_box(box, 64, 5);
  ASSERT_EQ(sites.size(), 64u);
  double nearest = 10;
  for (std::size_t i = 0; i < sites.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_GT(sites[i][axis], 0);
      EXPECT_LT(sites[i][axis], box.high[axis]);
    }
    for (std::size_t j = 0; j < i; ++j) nearest = std::min(nearest, length(sites[i] - sites[j]));
  }
  EXPECT_GT(nearest, 0.3);  // half a metre is the width of a cell; random points come much nearer
  EXPECT_EQ(spread_in_box(box, 64, 5), sites);
  EXPECT_NE(spread_in_box(box, 64, 6), sites);
}

}  // namespace
}  // namespace strataflow
