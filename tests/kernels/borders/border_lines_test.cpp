#include "kernels/borders/border_lines.h"

#include <gtest/gtest.h>

#include "kernels/borders/strips.h"

namespace strataflow {
namespace {

BorderNetwork borders_of(const TriangleSoup& soup, double corner_angle_deg = 45) {
  return find_radial_borders(soup.points, soup.triangles, soup.triangle_patch, corner_angle_deg);
}

TEST(RadialBorders, a_long_border_along_two_short_ones_is_two) {  // figure 4-5
  TriangleSoup soup;
  support::add_strip(soup, support::add_patch(soup, "long"), 6, 6, {0, 1, 0});
  support::add_strip(soup, support::add_patch(soup, "short"), 4, 4, {0, 0, 1});
  const auto first = static_cast<std::uint32_t>(soup.points.size());
  support::add_strip(soup, support::add_patch(soup, "shorter"), 2, 2, {0, 0.2, -1});
  for (std::uint32_t v = first; v < soup.points.size(); ++v) soup.points[v].x += 4;
  soup = support::weld(soup);
  const BorderNetwork network = borders_of(soup);
  ASSERT_EQ(network.borders.size(), 2u);
  EXPECT_EQ(network.borders[0].edge_count(), 4u);
  EXPECT_EQ(network.borders[1].edge_count(), 2u);
  EXPECT_EQ(soup.points[network.borders[1].nodes[0]], (Vec3{4, 0, 0}));
}

TEST(RadialBorders, count_the_nodes_of_three_triangles_on_the_poorer_side) {  // figure 4-7
  TriangleSoup soup;
  support::add_strip(soup, support::add_patch(soup, "five"), 4, 20, {0, 1, 0}, {4, 8, 12, 16});
  support::add_strip(soup, support::add_patch(soup, "six"), 5, 20, {0, 0, 1}, {5, 10, 15});
  soup = support::weld(soup);
  const BorderNetwork network = borders_of(soup);
  ASSERT_EQ(network.borders.size(), 1u) << "the sides conform";
  EXPECT_EQ(network.borders[0].edge_count(), 8u);
  EXPECT_EQ(network.borders[0].representative_count, 5u);
  EXPECT_EQ(network.borders[0].wanted_edge_count(), 4u);
}

TEST(RadialBorders, are_cut_where_the_contact_turns_sharply) {
  TriangleSoup soup = support::layered_box({0, 1, 2});  // a horizon inside a box of one patch
  soup = support::weld(soup);
  EXPECT_EQ(borders_of(soup).borders.size(), 4u);
  const BorderNetwork smooth = borders_of(soup, 180);
  ASSERT_EQ(smooth.borders.size(), 1u);
  EXPECT_TRUE(smooth.borders[0].is_closed);
  EXPECT_EQ(smooth.borders[0].wanted_edge_count(), std::max<std::size_t>(3, smooth.borders[0].representative_count));
}

TEST(RadialBorders, remember_the_order_of_most_edges) {  // figure 4-12
  TriangleSoup soup;
  support::add_strip(soup, support::add_patch(soup, "a"), 4, 4, {0, 1, 0});
  support::add_strip(soup, support::add_patch(soup, "b"), 4, 4, {0, 1, 1});
  support::add_strip(soup, support::add_patch(soup, "c"), 4, 4, {0, 0, 1});
  soup = support::weld(soup);
  const std::vector<std::uint32_t> order = borders_of(soup).borders.at(0).radial_order;
  EXPECT_EQ(order, (std::vector<std::uint32_t>{0, 1, 2}));
  for (Vec3& p : soup.points)  // on the first edge c passes under a
    if (p.x == 1 && p.y == 0 && p.z == 1) p = {1, 1, -0.5};
  EXPECT_EQ(borders_of(soup).borders.at(0).radial_order, order);
}

}  // namespace
}  // namespace strataflow
