#include "kernels/sealing/trim_overshoot.h"

#include <gtest/gtest.h>

#include "kernels/contacts/raw_surfaces.h"

namespace strataflow {
namespace {

/// A wall x = 0 and a sheet z = 0, ten wide, that goes past it by `jut`; both are cut along their contact.
TriangleSoup sheet_past_wall(double jut) {
  TriangleSoup soup;
  const std::uint32_t wall = support::add_patch(soup, "F1", Role::fault);
  support::add_quad(soup, wall, {0, 0, -20}, {0, 10, -20}, {0, 10, 0}, {0, 0, 0});
  support::add_quad(soup, wall, {0, 0, 0}, {0, 10, 0}, {0, 10, 20}, {0, 0, 20});
  const std::uint32_t sheet = support::add_patch(soup, "H1", Role::horizon);
  support::add_sheet(soup, sheet, {0, 0, 0}, {20, 10, 0}, 0);
  support::add_sheet(soup, sheet, {-jut, 0, 0}, {0, 10, 0}, 0);
  return soup;
}

TEST(TrimOvershoot, takes_what_juts_out_by_no_more_than_the_distance) {
  const TrimmedSurfaces trimmed = trim_overshoot(sheet_past_wall(1), 1.5);
  ASSERT_EQ(trimmed.pieces.size(), 1u);
  EXPECT_EQ(trimmed.pieces[0].entity, 1u);
  EXPECT_EQ(trimmed.pieces[0].triangle_count, 2u);
  EXPECT_DOUBLE_EQ(trimmed.pieces[0].area_m2, 10);
  EXPECT_EQ(support::area_m2(trimmed.soup, 1), 200);
  EXPECT_EQ(support::area_m2(trimmed.soup, 0), 400);
}

TEST(TrimOvershoot, what_reaches_further_truly_ends_there_and_stays) {
  const TriangleSoup soup = sheet_past_wall(4);
  const TrimmedSurfaces trimmed = trim_overshoot(soup, 1.5);
  EXPECT_TRUE(trimmed.pieces.empty());
  EXPECT_EQ(trimmed.soup.triangles, soup.triangles);
}

TEST(TrimOvershoot, what_only_such_a_piece_held_in_place_goes_with_it) {
  TriangleSoup soup = sheet_past_wall(1);
  // A rib that stands on the outer rim of what juts out.
  support::add_quad(soup, support::add_patch(soup, "H2", Role::horizon), {-1, 0, 0}, {-1, 10, 0}, {-1, 10, 1},
                    {-1, 0, 1});
  const TrimmedSurfaces trimmed = trim_overshoot(soup, 1.5);
  EXPECT_EQ(trimmed.pieces.size(), 2u);
  EXPECT_EQ(support::area_m2(trimmed.soup, 1), 200);
  EXPECT_EQ(support::area_m2(trimmed.soup, 2), 0);
}

TEST(TrimOvershoot, a_whole_surface_that_touches_nothing_stays_however_small) {
  const TriangleSoup soup = support::box_with_floating_fault();
  EXPECT_EQ(trim_overshoot(soup, 10).soup.triangles, soup.triangles);
}

}  // namespace
}  // namespace strataflow
