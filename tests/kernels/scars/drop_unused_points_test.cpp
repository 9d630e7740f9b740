#include "kernels/scars/drop_unused_points.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace strataflow {
namespace {

TEST(DropUnusedPoints, keeps_the_order_the_values_and_the_records_of_what_stays) {
  TriangleSoup soup;
  support::add_patch(soup, "H");
  for (int i = 0; i < 6; ++i) soup.points.push_back({1.0 * i, 0, 0});
  soup.triangles = {{1, 3, 5}};
  soup.triangle_patch = {0};
  soup.properties.push_back({"v", "", 2, {0, 0, 1, 10, 2, 20, 3, 30, 4, 40, 5, 50}});
  soup.border_stones = {0, 3};
  soup.border_starts = {{1, 3}, {3, 4}};
  std::vector<char> kept(6, 0);
  kept[2] = 1;
  EXPECT_EQ(drop_unused_points(soup, kept), (std::vector<std::uint32_t>{1, 2, 3, 5}));
  EXPECT_EQ(soup.triangles[0], (Triangle{0, 2, 3}));
  EXPECT_EQ(soup.points[3], (Vec3{5, 0, 0}));
  EXPECT_EQ(soup.properties[0].values, (std::vector<double>{1, 10, 2, 20, 3, 30, 5, 50}));
  EXPECT_EQ(soup.border_stones, std::vector<std::uint32_t>{2});
  ASSERT_EQ(soup.border_starts.size(), 1u);
  EXPECT_EQ(soup.border_starts[0], (std::array<std::uint32_t, 2>{0, 2}));
}

}  // namespace
}  // namespace strataflow
