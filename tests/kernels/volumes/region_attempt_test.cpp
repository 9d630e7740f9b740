#include "kernels/volumes/region_attempt.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernels/volumes/filled_model.h"
#include "kernels/volumes/region_boundary.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

RegionBoundary boundary_of(const TriangleSoup& soup, std::uint32_t region = 0) {
  const StructuralModel model = support::model_of(soup);
  return region_boundary(model, surface_triangles_of(model), region);
}

TEST(RegionBoundary, holds_each_triangle_once_and_knows_which_sides_look_inside) {
  const RegionBoundary boundary = boundary_of(support::box_with_floating_fault());
  ASSERT_EQ(boundary.facets.size(), 14u);
  EXPECT_EQ(std::count(boundary.sides.begin(), boundary.sides.end(), 3), 2);
  EXPECT_EQ(boundary.points.size(), 12u);
  for (const Triangle& facet : boundary.facets)
    for (const std::uint32_t vertex : facet) EXPECT_LT(vertex, boundary.points.size());
}

TEST(RegionAttempt, every_frame_gives_back_the_coordinates_bit_for_bit) {
  const RegionBoundary boundary = boundary_of(support::box({1000.25, -3e6, 0.125}, {1900.5, -2.9e6, 1.0}));
  for (const RegionAttempt& attempt : attempts_splitting_surfaces()) {
    const RegionFrame frame(boundary, attempt);
    for (const Vec3& p : boundary.coordinates) EXPECT_EQ(frame.restored(frame.sent(p)), p) << describe(attempt);
  }
}

TEST(RegionAttempt, a_shift_that_would_round_a_coordinate_is_not_made) {
  const RegionBoundary boundary = boundary_of(support::box({1e-9, 0, 0}, {1e9, 1e9, 1e9}));
  const RegionFrame frame(boundary, RegionAttempt{"pYQ"});
  for (const Vec3& p : boundary.coordinates) EXPECT_EQ(frame.sent(p).x, p.x);
}

TEST(RegionAttempt, stretches_needles_back_and_leaves_good_triangles_alone) {
  EXPECT_EQ(vertical_stretch(boundary_of(support::box())), 1);
  EXPECT_EQ(vertical_stretch(boundary_of(support::box({0, 0, 0}, {16, 16, 1}))), 16);
}

TEST(RegionAttempt, what_was_reversed_comes_back_in_the_boundarys_numbers) {
  const RegionBoundary boundary = boundary_of(support::box());
  const RegionAttempt attempt{"pYQ", false, true, true, true};
  const RegionFrame frame(boundary, attempt);
  const TetgenRequest request = request_for(boundary, attempt, frame, "", 0);
  TetgenResponse response;
  response.points = request.points;
  response.subfaces = request.facets;
  for (std::uint32_t f = 0; f < request.facets.size(); ++f) response.subface_facet.push_back(f);
  const RegionAnswer answer = answer_from(boundary, attempt, frame, response);
  EXPECT_EQ(answer.points, boundary.coordinates);
  for (std::size_t i = 0; i < answer.subfaces.size(); ++i)
    EXPECT_EQ(answer.subfaces[i], boundary.facets[answer.subface_facet[i]]);
}

TEST(RegionAttempt, keeping_surfaces_always_says_so_to_tetgen) {
  for (const RegionAttempt& attempt : attempts_keeping_surfaces())
    EXPECT_THAT(attempt.switches, testing::StartsWith("pY"));
}

TEST(RegionAttempt, asks_tetgen_for_dihedral_angles_only) {
  TetrahedralizeOptions options;
  options.max_volume_m3 = 5;
  EXPECT_EQ(interior_switches(options), "");
  options.min_dihedral_deg = 12;
  EXPECT_EQ(interior_switches(options), "q2.000000/12.000000");
}

}  // namespace
}  // namespace strataflow
