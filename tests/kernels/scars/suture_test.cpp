#include "kernels/scars/suture.h"

#include <gtest/gtest.h>

#include "base/id.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

SewnSoup sew(const TriangleSoup& soup, const std::vector<EdgePlace>& split = {}) {
  const auto mates = find_mates(soup.points.size(), soup.triangles, soup.triangle_patch);
  return suture(soup, mates, pair_borders(soup, mates, split).pairs);
}

TEST(Suture, joins_loose_triangles_into_one_sheet) {
  TriangleSoup soup;
  support::add_quad(soup, support::add_patch(soup, "H"), {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  const SewnSoup sewn = sew(soup);
  EXPECT_EQ(sewn.pairs.size(), 1u);
  EXPECT_EQ(sewn.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 5}}));
  EXPECT_EQ(sewn.mates[2], 3u);
  EXPECT_EQ(sewn.mates[3], 2u);
}

TEST(Suture, gives_joined_patches_one_number) {
  TriangleSoup soup;
  const std::uint32_t left = support::add_patch(soup, "H");
  soup.patch_entity.push_back(0);
  support::add_quad(soup, left + 1, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  support::add_quad(soup, left, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0});
  EXPECT_EQ(sew(soup).triangle_patch, (std::vector<std::uint32_t>{0, 0, 0, 0}));
}

TEST(Suture, keeps_two_points_where_stars_meet_in_a_point_only) {
  // Two bow-tie wings, each of two loose triangles sewn along one edge; they meet in the middle only (rule F2).
  TriangleSoup soup;
  const std::uint32_t patch = support::add_patch(soup, "H");
  support::add_triangle(soup, patch, {0, 0, 0}, {2, -1, 0}, {2, 0, 0});
  support::add_triangle(soup, patch, {0, 0, 0}, {2, 0, 0}, {2, 1, 0});
  support::add_triangle(soup, patch, {0, 0, 0}, {-2, 1, 0}, {-2, 0, 0});
  support::add_triangle(soup, patch, {0, 0, 0}, {-2, 0, 0}, {-2, -1, 0});
  const SewnSoup sewn = sew(soup);
  EXPECT_EQ(sewn.pairs.size(), 2u);
  EXPECT_EQ(sewn.triangles[0][0], sewn.triangles[1][0]);
  EXPECT_EQ(sewn.triangles[2][0], sewn.triangles[3][0]);
  EXPECT_NE(sewn.triangles[0][0], sewn.triangles[2][0]);
}

TEST(Suture, does_not_glue_an_open_edge_by_its_ends) {
  // A slit of three edges in a strip, the middle one not selected: sewing both its neighbours would close it too.
  TriangleSoup soup;
  const std::uint32_t patch = support::add_patch(soup, "H");
  const auto add = [&](double y0, double y1) {
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    for (int x = 0; x < 4; ++x) soup.points.insert(soup.points.end(), {{1.0 * x, y0, 0}, {1.0 * x, y1, 0}});
    for (std::uint32_t x = 0; x < 3; ++x) {
      const std::uint32_t a = first + 2 * x;
      soup.triangles.insert(soup.triangles.end(), {{a, a + 2, a + 3}, {a, a + 3, a + 1}});
      soup.triangle_patch.insert(soup.triangle_patch.end(), {patch, patch});
    }
  };
  add(0, 1);
  add(1, 2);
  const EdgePlace left{Vec3{0, 1, 0}, Vec3{1, 1, 0}}, right{Vec3{2, 1, 0}, Vec3{3, 1, 0}};
  const SewnSoup both = sew(soup, {left, right});
  EXPECT_EQ(both.pairs.size(), 1u);
  ASSERT_EQ(both.refused.size(), 2u);
  EXPECT_EQ(both.refused[0].reason, LipRefusal::pinch);
  EXPECT_EQ(sew(soup, {left}).pairs.size(), 1u);
  EXPECT_EQ(sew(soup).pairs.size(), 3u);
}

}  // namespace
}  // namespace strataflow
