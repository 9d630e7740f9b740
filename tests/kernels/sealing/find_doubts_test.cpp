#include "kernels/sealing/find_doubts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernels/contacts/raw_surfaces.h"
#include "kernels/cutting/cut_surfaces.h"

namespace strataflow {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::vector<Doubt> doubts(const TriangleSoup& soup, double distance_m, const std::vector<NamedContact>& contacts = {}) {
  const Result<std::vector<Doubt>> found = find_doubts(soup, distance_m, contacts);
  EXPECT_TRUE(found) << (found ? "" : describe(found.failure()));
  return found ? *found : std::vector<Doubt>{};
}

/// A box that a fault x = 5 parts in two; a surface z = 5 comes from x = 0, passes the fault and ends free at x = 7.
TriangleSoup box_with_jut(Role role) {
  TriangleSoup soup = support::box({0, 0, 0}, {10, 10, 10});
  support::add_grid(soup, support::add_patch(soup, "F1", Role::fault), 2, 2,
                    [](double u, double v) { return Vec3{5, 10 * u, 10 * v}; });
  support::add_grid(soup, support::add_patch(soup, "J", role), 2, 2,
                    [](double u, double v) { return Vec3{7 * u, 10 * v, 5}; });
  const Result<CutResult> cut = cut_surfaces(soup);
  EXPECT_TRUE(cut);
  return cut->soup;
}

TEST(FindDoubts, names_a_horizon_that_passes_a_fault_and_ends_free) {
  const std::vector<Doubt> found = doubts(box_with_jut(Role::horizon), 0.1);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].text, StartsWith("J juts 2 m past F1 at (7.0, "));
  EXPECT_EQ(found[0].remedy, "seal.contacts = [\"J -> F1 within 2.2\"]");
}

TEST(FindDoubts, a_fault_may_pass_a_fault_and_die_unless_it_was_said_to_end_there) {
  EXPECT_TRUE(doubts(box_with_jut(Role::fault), 0.1).empty());
  EXPECT_TRUE(doubts(box_with_jut(Role::fault), 0.1, {{"F1", "J", 1}}).empty());
  EXPECT_EQ(doubts(box_with_jut(Role::fault), 0.1, {{"J", "F1", 1}}).size(), 1u);
}

TEST(FindDoubts, a_horizon_that_starts_at_a_fault_passes_nothing) {
  TriangleSoup soup = box_with_jut(Role::horizon);
  std::size_t next = 0;  // only what is beyond the fault
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const auto& corners = soup.triangles[t];
    if (soup.entities[soup.patch_entity[soup.triangle_patch[t]]].name == "J" &&
        std::any_of(corners.begin(), corners.end(), [&](std::uint32_t p) { return soup.points[p].x < 5; }))
      continue;
    soup.triangles[next] = corners;
    soup.triangle_patch[next++] = soup.triangle_patch[t];
  }
  soup.triangles.resize(next);
  soup.triangle_patch.resize(next);
  EXPECT_TRUE(doubts(soup, 0.1).empty());
}

/// A box of 10 m with a fault x = 5; left of it a horizon z = 5 and, `thickness_m` above, another one.
TriangleSoup box_with_thin_layer(double thickness_m, double right_end) {
  TriangleSoup soup = support::box({0, 0, 0}, {10, 10, 10});
  support::add_grid(soup, support::add_patch(soup, "F1", Role::fault), 2, 2,
                    [](double u, double v) { return Vec3{5, 10 * u, 10 * v}; });
  for (const auto& [name, z] : {std::pair{"H1", 5.0}, {"H2", 5.0 + thickness_m}})
    support::add_grid(soup, support::add_patch(soup, name, Role::horizon), 2, 2,
                      [z = z, right_end](double u, double v) { return Vec3{right_end * u, 10 * v, z}; });
  const Result<CutResult> cut = cut_surfaces(soup);
  EXPECT_TRUE(cut);
  return cut->soup;
}

TEST(FindDoubts, names_thin_small_regions_where_a_surface_ends_on_another_and_what_would_merge_them) {
  const std::vector<Doubt> found = doubts(box_with_thin_layer(0.2, 5), 4);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].text,
              StartsWith("a sliver of 10 m3 between box, F1, H1, H2, 0.189 m thick on average, at ("));
  EXPECT_THAT(found[0].remedy, HasSubstr("seal.micro_region_volume_m3 = 11"));
}

TEST(FindDoubts, regions_that_are_small_or_thin_alone_or_between_crossing_surfaces_are_meant) {
  EXPECT_TRUE(doubts(box_with_thin_layer(0.5, 5), 4).empty()) << "thick";
  EXPECT_TRUE(doubts(box_with_thin_layer(0.12, 5), 1.7).empty()) << "0.116 m thick, but larger than 1.7³ m3";
  EXPECT_TRUE(doubts(box_with_thin_layer(0.2, 10), 4).empty()) << "they cross the fault";
  EXPECT_TRUE(doubts({}, 1).empty());
}

}  // namespace
}  // namespace strataflow
