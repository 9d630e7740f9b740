#include "kernels/contacts/find_borders.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/contacts/raw_surfaces.h"

namespace strataflow {
namespace {

using support::add_grid;
using support::add_patch;

TEST(FindBorders, a_rectangle_has_four_between_its_corners) {
  TriangleSoup soup;
  add_grid(soup, add_patch(soup, "H1"), 3, 2, [](double u, double v) { return Vec3{3 * u, 2 * v, 0}; });
  const std::vector<Border> borders = find_borders(soup);
  ASSERT_EQ(borders.size(), 4u);
  std::vector<std::size_t> edges;
  for (const Border& border : borders) {
    EXPECT_FALSE(border.is_closed);
    EXPECT_EQ(border.points.size(), border.edge_count() + 1);
    edges.push_back(border.edge_count());
  }
  std::sort(edges.begin(), edges.end());
  EXPECT_EQ(edges, (std::vector<std::size_t>{2, 2, 3, 3}));
}

TEST(FindBorders, a_disc_has_one_closed_border_unless_it_turns_sharply) {
  TriangleSoup soup;
  const std::uint32_t patch = add_patch(soup, "disc");
  for (int i = 0; i < 24; ++i)
    support::add_triangle(soup, patch, {0, 0, 0}, {std::cos(i * M_PI / 12), std::sin(i * M_PI / 12), 0},
                          {std::cos((i + 1) % 24 * M_PI / 12), std::sin((i + 1) % 24 * M_PI / 12), 0});
  std::vector<Border> borders = find_borders(soup);
  ASSERT_EQ(borders.size(), 1u);
  EXPECT_TRUE(borders[0].is_closed);
  EXPECT_EQ(borders[0].points.size(), 24u);
  EXPECT_EQ(borders[0].edge_count(), 24u);
  EXPECT_EQ(find_borders(soup, {.stone_angle_deg = 10}).size(), 24u);
}

TEST(FindBorders, every_edge_of_a_border_names_its_triangle) {
  const TriangleSoup soup = support::raw_box(0.1, 3);
  for (const Border& border : find_borders(soup))
    for (std::size_t i = 0; i < border.edge_count(); ++i) {
      const Vec3 &a = soup.points[border.points[i]], &b = soup.points[border.points[(i + 1) % border.points.size()]];
      int corners = 0;
      for (const std::uint32_t p : soup.triangles[border.triangles[i]])
        corners += soup.points[p] == a || soup.points[p] == b;
      EXPECT_EQ(corners, 2);
      EXPECT_EQ(soup.patch_entity[soup.triangle_patch[border.triangles[i]]], border.entity);
    }
}

TEST(FindBorders, a_closed_surface_and_a_seam_between_two_patches_of_one_entity_have_none) {
  EXPECT_TRUE(find_borders(support::box()).empty());
  TriangleSoup soup = support::box();
  const std::uint32_t second = support::add_patch_of(soup, 0);
  for (std::size_t t = 0; t < 4; ++t) soup.triangle_patch[t] = second;
  EXPECT_TRUE(find_borders(soup).empty());
  soup.patch_entity[second] = 1;
  soup.entities.push_back({"other", Role::boundary});
  EXPECT_FALSE(find_borders(soup).empty());
}

TEST(FindBorders, a_slit_ends_in_stones) {
  // Two halves that are one from y = 2 on: the slit's lips meet in a tip.
  TriangleSoup soup;
  const std::uint32_t patch = add_patch(soup, "H1");
  add_grid(soup, patch, 2, 4, [](double u, double v) { return Vec3{u * (v < 0.4 ? 1.9 : 2.0), 4 * v, 0}; });
  add_grid(soup, patch, 2, 4, [](double u, double v) {
    return Vec3{2 + (v < 0.4 ? 0.1 * (1 - u) : 0.0) + 2 * u, 4 * v, 0};
  });
  int ends_at_tip = 0;
  for (const Border& border : find_borders(soup))
    for (const std::uint32_t p : {border.points.front(), border.points.back()})
      ends_at_tip += soup.points[p] == Vec3{2, 2, 0};
  EXPECT_EQ(ends_at_tip, 2);
}

}  // namespace
}  // namespace strataflow
