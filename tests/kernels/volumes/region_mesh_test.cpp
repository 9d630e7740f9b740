#include "kernels/volumes/region_mesh.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/volume_mesh.h"

namespace strataflow {
namespace {

using testing::HasSubstr;

/// Two tetrahedra on either side of the triangle 0 1 2, apexes 3 (above) and 4 (below).
const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
const Tet upper{0, 1, 2, 3}, lower{0, 2, 1, 4};

/// The region made of both, with or without the triangle between them as a dangling surface.
RegionBoundary double_pyramid(bool has_dangling_triangle) {
  RegionBoundary boundary;
  boundary.points = {0, 1, 2, 3, 4};
  boundary.coordinates = points;
  boundary.facets = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {1, 0, 4}, {2, 1, 4}, {0, 2, 4}};
  boundary.sides.assign(6, 1);  // normals point out: the region is on the negative sides
  if (has_dangling_triangle) {
    boundary.facets.push_back({0, 1, 2});
    boundary.sides.push_back(3);
  }
  boundary.triangles.resize(boundary.facets.size());
  return boundary;
}

std::string reason(const std::variant<RegionMesh, Rejection>& verdict) {
  const auto* rejection = std::get_if<Rejection>(&verdict);
  return rejection ? rejection->reason : "";
}

TEST(VerifiedRegionMesh, takes_a_good_mesh_and_tells_the_tetrahedra_beside_each_facet) {
  const auto verdict = verified_region_mesh(double_pyramid(true), points, {upper, lower}, 1.0 / 3);
  ASSERT_TRUE(std::holds_alternative<RegionMesh>(verdict)) << reason(verdict);
  const RegionMesh& mesh = std::get<RegionMesh>(verdict);
  EXPECT_EQ(mesh.facet_tets[0], (std::array<std::uint32_t, 2>{0, no_index}));
  EXPECT_EQ(mesh.facet_tets[3], (std::array<std::uint32_t, 2>{1, no_index}));
  EXPECT_EQ(mesh.facet_tets[6], (std::array<std::uint32_t, 2>{1, 0}));
}

TEST(VerifiedRegionMesh, drops_what_lies_outside_and_points_only_used_there) {
  RegionBoundary boundary = double_pyramid(true);
  boundary.sides = {1, 1, 1, 0, 0, 0, 2};  // only the upper half is the region
  std::vector<Vec3> with_extra = points;
  with_extra.push_back({0.1, 0.1, -0.1});
  const std::uint32_t inner = 5;
  const std::vector<Tet> tets{upper, {0, 2, 1, inner}, {0, 1, 4, inner}, {1, 2, 4, inner}, {2, 0, 4, inner}};
  const auto verdict = verified_region_mesh(boundary, with_extra, tets, 1.0 / 6);
  ASSERT_TRUE(std::holds_alternative<RegionMesh>(verdict)) << reason(verdict);
  EXPECT_EQ(std::get<RegionMesh>(verdict).tets, (std::vector<Tet>{upper}));
  EXPECT_TRUE(std::get<RegionMesh>(verdict).interior_points.empty());
}

TEST(VerifiedRegionMesh, rejects_a_mesh_that_lost_a_surface_triangle) {
  EXPECT_THAT(reason(verified_region_mesh(double_pyramid(false), points, {upper}, 1.0 / 6)), HasSubstr("not a face"));
}

TEST(VerifiedRegionMesh, rejects_a_mesh_that_leaks) {
  RegionBoundary boundary = double_pyramid(false);
  for (std::size_t f : {3u, 4u, 5u}) boundary.sides[f] = 0;  // says that the lower half is outside
  EXPECT_THAT(reason(verified_region_mesh(boundary, points, {upper, lower}, 1.0 / 3)), HasSubstr("inside and outside"));
}

TEST(VerifiedRegionMesh, rejects_flat_inverted_and_overlapping_tetrahedra) {
  std::vector<Vec3> flat = points;
  flat[4].z = 0;
  EXPECT_THAT(reason(verified_region_mesh(double_pyramid(true), flat, {upper, lower}, 1.0 / 6)), HasSubstr("flat"));
  EXPECT_THAT(reason(verified_region_mesh(double_pyramid(true), points, {upper, {0, 1, 2, 4}}, 1.0 / 3)),
              HasSubstr("same side"));
}

TEST(VerifiedRegionMesh, rejects_a_wrong_volume) {
  EXPECT_THAT(reason(verified_region_mesh(double_pyramid(true), points, {upper, lower}, 0.3333)), HasSubstr("volume"));
}

}  // namespace
}  // namespace strataflow
