#include "kernels/sealing/welded_soup.h"

#include <gtest/gtest.h>

#include "kernels/topology/keep_triangles.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

TriangleSoup two_sheets_and_a_needle() {
  TriangleSoup soup;
  const std::uint32_t first = support::add_patch(soup, "H1"), second = support::add_patch(soup, "H2");
  support::add_triangle(soup, first, {0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  support::add_triangle(soup, first, {0, 0, 0}, {0, 0, 0}, {1, 1, 0});
  support::add_triangle(soup, second, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  return soup;
}

TEST(WeldedSoup, shares_points_and_leaves_out_what_has_no_area) {
  const WeldedSoup mesh(two_sheets_and_a_needle());
  EXPECT_EQ(mesh.points.size(), 4u);
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.triangles[1][0], mesh.triangles[0][1]);
  EXPECT_EQ(mesh.entity, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(mesh.origin, (std::vector<std::uint32_t>{0, 2}));
}

TEST(KeepTriangles, leaves_the_marked_ones_with_their_patches) {
  TriangleSoup soup = two_sheets_and_a_needle();
  const Triangle last = soup.triangles[2];
  keep_triangles(soup, {0, 0, 1});
  EXPECT_EQ(soup.triangles, (std::vector<Triangle>{last}));
  EXPECT_EQ(soup.triangle_patch, (std::vector<std::uint32_t>{1}));
}

}  // namespace
}  // namespace strataflow
