#include "kernels/sealing/trim_outside.h"

#include <gtest/gtest.h>

#include "kernels/contacts/raw_surfaces.h"

namespace strataflow {
namespace {

/// A unit box with a flap outside that hangs on one of its edges, and a sheet inside that touches nothing.
TriangleSoup box_with_flap() {
  TriangleSoup soup = support::box();
  support::add_quad(soup, support::add_patch(soup, "H1", Role::horizon), {1, 0, 1}, {3, 0, 1}, {3, 1, 1}, {1, 1, 1});
  support::add_sheet(soup, support::add_patch(soup, "F1", Role::fault), {0.2, 0.2, 0}, {0.8, 0.8, 0}, 0.5);
  return soup;
}

TEST(TrimOutside, takes_what_lies_outside_the_boundary_and_leaves_what_dies_inside) {
  const Result<TrimmedSurfaces> trimmed = trim_outside(box_with_flap());
  ASSERT_TRUE(trimmed) << describe(trimmed.failure());
  ASSERT_EQ(trimmed->pieces.size(), 1u);
  EXPECT_EQ(trimmed->pieces[0].entity, 1u);
  EXPECT_EQ(trimmed->pieces[0].triangle_count, 2u);
  EXPECT_DOUBLE_EQ(trimmed->pieces[0].area_m2, 2);
  EXPECT_EQ(support::area_m2(trimmed->soup, 0), 6);
  EXPECT_EQ(support::area_m2(trimmed->soup, 1), 0);
  EXPECT_NEAR(support::area_m2(trimmed->soup, 2), 0.36, 1e-12);
}

TEST(TrimOutside, without_a_boundary_that_encloses_anything_nothing_changes) {
  TriangleSoup soup = box_with_flap();
  soup.entities[0].role = Role::horizon;
  EXPECT_EQ(trim_outside(soup)->soup.triangles, soup.triangles);
  TriangleSoup open = box_with_flap();
  open.triangles.erase(open.triangles.begin());
  open.triangle_patch.erase(open.triangle_patch.begin());
  const Result<TrimmedSurfaces> same = trim_outside(open);
  ASSERT_TRUE(same);
  EXPECT_TRUE(same->pieces.empty());
  EXPECT_EQ(same->soup.triangles, open.triangles);
}

}  // namespace
}  // namespace strataflow
