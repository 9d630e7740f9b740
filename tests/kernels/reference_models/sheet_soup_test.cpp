#include "kernels/reference_models/sheet_soup.h"

#include <gtest/gtest.h>

#include "kernels/reference_models/soup_topology.h"

namespace strataflow {
namespace {

double area_m2(const TriangleSoup& soup) {
  double sum = 0;
  for (const auto& [a, b, c] : soup.triangles)
    sum += 0.5 * length(cross(soup.points[b] - soup.points[a], soup.points[c] - soup.points[a]));
  return sum;
}

const std::vector<Entity> one_horizon{{"H", Role::horizon}};

TEST(SheetSoup, makes_a_grid_of_halved_quads) {
  SheetSoup sheets(one_horizon);
  sheets.add_grid(0, 4, 3, [](std::uint32_t i, std::uint32_t j) { return Vec3{double(i), double(j), 0}; });
  const TriangleSoup soup = sheets.take();
  EXPECT_EQ(soup.points.size(), 12u);
  EXPECT_EQ(soup.triangles.size(), 12u);
  EXPECT_DOUBLE_EQ(area_m2(soup), 6);
}

TEST(SheetSoup, clips_along_the_zero_of_the_clearance_and_shares_the_new_points) {
  SheetSoup sheets(one_horizon);
  const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheets.add_clipped_sheet(0, square, {{0, 1, 2}, {0, 2, 3}}, {0.25, -0.75, -0.75, 0.25});  // keeps x <= 0.25
  const TriangleSoup soup = sheets.take();
  EXPECT_NEAR(area_m2(soup), 0.25, 1e-15);
  EXPECT_EQ(soup.points.size(), 5u) << "two corners, three cuts; the corners cut away are dropped";
}

TEST(SheetSoup, welds_equal_positions_and_keeps_the_order_of_the_others) {
  SheetSoup sheets(one_horizon);
  sheets.add_sheet(0, {{5, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {{0, 1, 2}});
  sheets.add_sheet(0, {{1, 1, 0}, {0, 7, 0}, {1, 0, 0}}, {{0, 1, 2}});
  const TriangleSoup soup = sheets.take_welded();
  EXPECT_EQ(soup.points, (std::vector<Vec3>{{5, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 7, 0}}));
  EXPECT_EQ(soup.triangles, (std::vector<Triangle>{{0, 1, 2}, {2, 3, 1}}));
}

TEST(SheetSoup, starts_a_patch_per_sheet) {
  SheetSoup sheets(one_horizon);
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  sheets.add_sheet(0, points, {{0, 1, 2}});
  sheets.add_sheet(0, points, {{0, 1, 2}});
  const TriangleSoup soup = sheets.take();
  EXPECT_EQ(soup.patch_entity, (std::vector<std::uint32_t>{0, 0}));
  EXPECT_EQ(soup.triangle_patch, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(soup.points.size(), 6u);
}

}  // namespace
}  // namespace strataflow
