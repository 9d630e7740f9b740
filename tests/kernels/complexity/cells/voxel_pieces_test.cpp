#include "kernels/complexity/cells/voxel_pieces.h"

#include <gtest/gtest.h>

#include "kernels/complexity/models.h"

namespace strataflow {
namespace {

double area_of(const StructuralModel& model) {
  double sum = 0;
  for (const Triangle& t : model.triangles)
    sum += 0.5 * length(cross(model.points[t[1]] - model.points[t[0]], model.points[t[2]] - model.points[t[0]]));
  return sum;
}

TEST(VoxelPieces, share_out_all_area_all_length_and_every_corner) {
  const StructuralModel model = reference_model("A3", 100);
  double line_m = 0;
  for (const Line& line : model.lines)
    for (std::size_t i = 0; i + (line.is_closed() ? 0 : 1) < line.vertices.size(); ++i)
      line_m += length(model.points[line.vertices[(i + 1) % line.vertices.size()]] - model.points[line.vertices[i]]);
  for (const std::uint32_t cells : {1u, 50u, 3000u}) {
    const VoxelGrid grid = cut_into_voxels(model.box, cells);
    const CellPieces pieces = cut_by_voxels(model, grid);
    double area_m2 = 0, pieces_m = 0;
    for (const SurfacePiece& piece : pieces.surface_pieces) area_m2 += piece.area_m2;
    for (const LinePiece& piece : pieces.line_pieces) pieces_m += piece.length_m;
    EXPECT_NEAR(area_m2 / area_of(model), 1, 1e-12);
    EXPECT_NEAR(pieces_m / line_m, 1, 1e-12);
    EXPECT_EQ(pieces.corners.size(), model.corners.size());
    EXPECT_EQ(pieces.cell_count(), grid.cell_count());
  }
}

TEST(VoxelPieces, a_horizon_in_the_plane_between_voxels_belongs_to_the_upper_ones) {
  const StructuralModel model = model_of(support::layered_box({0, 0.5, 1}));
  const CellPieces pieces = cut_by_voxels(model, cut_into_voxels(model.box, 8));
  for (std::size_t cell = 0; cell < 8; ++cell) {
    double horizon_m2 = 0;
    for (const SurfacePiece& piece : pieces.surfaces_in(cell))
      if (model.entities[model.surfaces[model.triangle_surface[piece.triangle]].entity].name == "H1")
        horizon_m2 += piece.area_m2;
    EXPECT_NEAR(horizon_m2, cell < 4 ? 0 : 0.25, 1e-15);
  }
}

TEST(VoxelPieces, know_which_edges_of_their_triangle_pass) {
  const StructuralModel model = model_of(support::layered_box({0, 0.4, 1}));
  const CellPieces whole = cut_by_voxels(model, cut_into_voxels(model.box, 1));
  for (const SurfacePiece& piece : whole.surface_pieces) EXPECT_EQ(piece.edges, 7u);
  for (const LinePiece& piece : whole.line_pieces) EXPECT_EQ(piece.ends, 3u);
}

}  // namespace
}  // namespace strataflow
