#include "kernels/complexity/cells/ball_pieces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/complexity/models.h"

namespace strataflow {
namespace {

double horizon_area(const StructuralModel& model, const Vec3& centre, double radius_m) {
  const CellPieces pieces = cut_by_balls(model, {centre}, radius_m);
  double sum = 0;
  for (const SurfacePiece& piece : pieces.surface_pieces)
    if (model.entities[model.surfaces[model.triangle_surface[piece.triangle]].entity].name == "H1") sum += piece.area_m2;
  return sum;
}

TEST(BallPieces, of_a_plane_are_discs) {
  const StructuralModel model = model_of(support::layered_box({0, 0.5, 1}));
  EXPECT_NEAR(horizon_area(model, {0.5, 0.4, 0.6}, 0.2), std::numbers::pi * (0.04 - 0.01), 1e-14);
  EXPECT_NEAR(horizon_area(model, {0.5, 0.5, 0.9}, 0.3), 0, 1e-15);            // does not reach it
  EXPECT_NEAR(horizon_area(model, {0.5, 0.5, 0.5}, 2), 1, 1e-14);              // swallows it
  EXPECT_NEAR(horizon_area(model, {0, 0.5, 0.5}, 0.25), std::numbers::pi / 32, 1e-14);  // half a disc
  EXPECT_NEAR(horizon_area(model, {1, 1, 0.5}, 0.25), std::numbers::pi / 64, 1e-14);    // a quarter
}

TEST(BallPieces, exist_only_for_triangles_that_are_reached) {
  const StructuralModel model = model_of(support::layered_box({0, 0.5, 1}));
  const CellPieces pieces = cut_by_balls(model, {{0.8, 0.2, 0.5}, {0.5, 0.5, 0.5}}, 0.1);
  EXPECT_EQ(pieces.surfaces_in(0).size(), 1u);  // the diagonal is out of reach
  EXPECT_EQ(pieces.surfaces_in(0)[0].edges, 0u);
  EXPECT_EQ(pieces.surfaces_in(1).size(), 2u);
  for (const SurfacePiece& piece : pieces.surfaces_in(1)) EXPECT_NE(piece.edges, 0u);
}

TEST(BallPieces, hold_the_lines_and_corners_within_the_radius) {
  const StructuralModel model = model_of(fault_below_horizon(45));  // its contact runs along y at x = 5, z = 2
  const CellPieces pieces = cut_by_balls(model, {{5, 5, 2}, {5, 0, 2}}, 1);
  ASSERT_EQ(pieces.lines_in(0).size(), 1u);
  EXPECT_NEAR(pieces.lines_in(0)[0].length_m, 2, 1e-12);
  EXPECT_EQ(pieces.lines_in(0)[0].ends, 0u);
  EXPECT_TRUE(pieces.corners_in(0).empty());
  EXPECT_EQ(pieces.corners_in(1).size(), 1u);
  EXPECT_NEAR(pieces.resolution_m, std::cbrt(4 * std::numbers::pi / 3), 1e-15);
}

}  // namespace
}  // namespace strataflow
