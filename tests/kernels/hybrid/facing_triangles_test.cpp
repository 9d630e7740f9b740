#include "kernels/hybrid/facing_triangles.h"

#include <gtest/gtest.h>

#include "base/id.h"
#include "plate.h"

namespace strataflow {
namespace {

TEST(FindFacingTriangles, pairs_the_two_sides_of_a_plate) {  // X11
  const support::Plate plate = support::plate(2, [](double, double) { return 0.2; });
  FacingCounts counts;
  const std::vector<FacingPair> pairs = find_facing_triangles(plate.model, plate.sites, counts);
  EXPECT_EQ(pairs.size(), 8u);  // as many as triangles on one side
  EXPECT_EQ(counts.pairs, 8u);
  for (const FacingPair& pair : pairs)
    for (int k = 0; k < 3; ++k) EXPECT_EQ(plate.sites[pair.bottom[k]], plate.sites[pair.top[k]]);
}

TEST(FindFacingTriangles, leaves_triangles_without_common_sites_alone) {
  support::Plate plate = support::plate(2, [](double, double) { return 0.2; });
  for (std::size_t p = 0; p < plate.sites.size(); ++p)
    if (plate.model.points[p] == Vec3{1, 1, 0}) plate.sites[p] = 99;
  FacingCounts counts;
  EXPECT_EQ(find_facing_triangles(plate.model, plate.sites, counts).size(), 2u);  // six of eight touch the middle
  plate.sites.assign(plate.sites.size(), no_index);
  EXPECT_TRUE(find_facing_triangles(plate.model, plate.sites, counts).empty());
}

TEST(FindFacingTriangles, counts_what_would_be_inverted) {
  support::Plate plate = support::plate(1, [](double, double) { return 0.2; });
  for (std::size_t p = 0; p < plate.sites.size(); ++p) {  // above: each point the site of the opposite corner
    const Vec3& at = plate.model.points[p];
    if (at.z > 0) plate.sites[p] = static_cast<std::uint32_t>((1 - at.x) * 2 + (1 - at.y));
  }
  FacingCounts counts;
  find_facing_triangles(plate.model, plate.sites, counts);
  EXPECT_EQ(counts.inverted, 2u);  // prisms that turn over half way up
}

}  // namespace
}  // namespace strataflow
