#include "kernels/contacts/find_contacts.h"

#include <gtest/gtest.h>

#include <set>

#include "kernels/contacts/raw_surfaces.h"
#include "kernels/reference_models/generate_reference_model.h"

namespace strataflow {
namespace {

using support::add_grid;
using support::add_patch;
using support::raw_box;

TEST(FindContacts, borders_that_stop_short_are_found_with_their_gap) {
  const TriangleSoup raw = raw_box(0.25, 4);
  EXPECT_TRUE(find_contacts(raw, {.distance_m = 0.2, .sag_ratio = 0}).constraints.borders.empty());
  const FoundContacts found = find_contacts(raw, {.distance_m = 0.3});
  ASSERT_EQ(found.constraints.borders.size(), 12u);
  for (const ContactGap& gap : found.gaps) {
    EXPECT_NEAR(gap.max_gap_m, 0.25, 1e-12);
    EXPECT_FALSE(gap.overshoots);
  }
  const std::string text = describe(raw, found.constraints.borders[0], found.gaps[0]);
  EXPECT_EQ(text.find("F1 stops 0.25 m short of box at ("), 0u) << text;
}

TEST(FindContacts, borders_that_overshoot_are_found_and_said_to) {
  const TriangleSoup raw = raw_box(-0.25, 4);
  const FoundContacts found = find_contacts(raw, {.distance_m = 0.3});
  ASSERT_EQ(found.constraints.borders.size(), 12u);
  for (const ContactGap& gap : found.gaps) EXPECT_TRUE(gap.overshoots);
  EXPECT_EQ(describe(raw, found.constraints.borders[0], found.gaps[0]).find("F1 overshoots box by 0.354 m at"),
            0u);  // at a corner
}

TEST(FindContacts, what_conforms_already_is_no_contact_to_make) {
  EXPECT_TRUE(find_contacts(support::layered_box({0, 0.4, 1}), {.distance_m = 0.1}).constraints.borders.empty());
  const TriangleSoup raw = raw_box(0.1, 4);
  const ConstrainedCut once = support::cut(raw, find_contacts(raw, {.distance_m = 0.2}).constraints);
  EXPECT_TRUE(find_contacts(once.soup, {.distance_m = 0.2}).constraints.borders.empty());
}

TEST(FindContacts, a_fault_that_dies_inside_is_left_alone) {
  // The tip of F1 in A6 and both of F1's and F2's in A3 end in the rock; horizons pass close by their ends.
  const TriangleSoup raw = *generate_reference_model("A3", {.resolution_m = 60, .raw_ratio = 0.01});
  for (const BorderOnSurface& border : find_contacts(raw, {.distance_m = 24}).constraints.borders)
    EXPECT_NE(raw.entities[border.entity].role, Role::fault) << raw.entities[border.entity].name;
}

TEST(FindContacts, the_ends_of_a_slit_slide_on_the_tips_of_the_fault) {
  const TriangleSoup raw = *generate_reference_model("A3", {.resolution_m = 60, .raw_ratio = 0.01});
  const FoundContacts found = find_contacts(raw, {.distance_m = 24});
  EXPECT_EQ(found.constraints.stones.size(), 12u);  // two ends of two faults in three horizons
  for (const StoneOnBorder& stone : found.constraints.stones)
    EXPECT_EQ(raw.entities[stone.controller].role, Role::fault);
}

TEST(FindContacts, a_border_beside_a_parallel_surface_does_not_belong_to_it) {
  TriangleSoup soup;
  for (const double z : {0.0, 0.1})
    add_grid(soup, add_patch(soup, "H" + std::to_string(z), Role::horizon), 4, 4, [&](double u, double v) {
      return Vec3{4 * u, 4 * v, z + 0.02 * u};
    });
  EXPECT_TRUE(find_contacts(soup, {.distance_m = 0.5}).constraints.borders.empty());
}

TEST(FindContacts, a_border_that_passes_from_one_surface_to_the_next_is_divided) {
  TriangleSoup soup;
  add_grid(soup, add_patch(soup, "F1"), 4, 2, [](double u, double v) { return Vec3{0.3, 5 * u, 2 * v - 1}; });
  add_grid(soup, add_patch(soup, "F2"), 4, 2, [](double u, double v) { return Vec3{0.3 + u, 5 + 5 * u, 2 * v - 1}; });
  add_grid(soup, add_patch(soup, "H1"), 4, 10, [](double u, double v) {
    return Vec3{0.4 + 4 * u + (v > 0.5 ? 2 * v - 1 : 0), 10 * v, 0.1};
  });
  const FoundContacts found = find_contacts(soup, {.distance_m = 0.3});
  ASSERT_EQ(found.constraints.borders.size(), 2u);
  std::set<std::uint32_t> controllers;
  for (const BorderOnSurface& border : found.constraints.borders) controllers.insert(border.controller);
  EXPECT_EQ(controllers, (std::set<std::uint32_t>{0, 1}));
  EXPECT_EQ(found.constraints.borders[0].points.size() + found.constraints.borders[1].points.size(), 12u);
}

TEST(NameContacts, picks_the_nearest_border_all_within_a_distance_or_one_by_number) {
  const TriangleSoup raw = raw_box(0.25, 3);
  const auto count = [&](const std::string& text) {
    const Result<FoundContacts> found = name_contacts(raw, {text}, FindContactsOptions{});
    EXPECT_TRUE(found) << describe(found.failure());
    return found ? found->constraints.borders.size() : 0;
  };
  EXPECT_EQ(count("H1 -> F1"), 1u);
  EXPECT_EQ(count("H1 -> F1 within 0.3"), 2u);
  EXPECT_EQ(count("F1->box within 0.3"), 4u);
  EXPECT_EQ(count("F1.border 2 -> box"), 1u);
  const Result<FoundContacts> nearest = name_contacts(raw, {"H1 -> F1"}, FindContactsOptions{});
  EXPECT_NEAR(nearest->gaps[0].max_gap_m, 0.25, 1e-12);
}

TEST(NameContacts, a_border_without_a_corner_is_divided_among_the_controllers_named_for_it) {
  TriangleSoup soup;
  add_grid(soup, add_patch(soup, "H", Role::horizon), 4, 8, [](double u, double v) { return Vec3{9.8 * u, 10 * v, 5}; });
  for (const double first : {0.0, 5.0})  // a fault that another one goes on from
    add_grid(soup, add_patch(soup, first == 0 ? "F1" : "F2", Role::fault), 4, 4,
             [&](double u, double v) { return Vec3{10, first + 5 * u, 10 * v}; });
  const Result<FoundContacts> found = name_contacts(soup, {"H -> F1 within 0.3", "H -> F2 within 0.3"}, {});
  ASSERT_TRUE(found) << describe(found.failure());
  ASSERT_EQ(found->constraints.borders.size(), 2u);
  EXPECT_EQ(found->constraints.borders[0].points.size(), 5u);
  EXPECT_EQ(found->constraints.borders[1].points.size(), 5u);
  EXPECT_NE(found->constraints.borders[0].controller, found->constraints.borders[1].controller);
  EXPECT_FALSE(name_contacts(soup, {"H -> F1 within 0.3"}, {}));
}

TEST(NameContacts, named_contacts_come_before_found_ones_of_the_same_border) {
  const TriangleSoup raw = raw_box(0.25, 3);
  const FoundContacts named = *name_contacts(raw, {"H1 -> F1 within 0.3"}, FindContactsOptions{});
  const FoundContacts all = joined(named, find_contacts(raw, {.distance_m = 0.3}));
  EXPECT_EQ(all.constraints.borders.size(), 12u);
  EXPECT_EQ(all.gaps.size(), 12u);
  EXPECT_EQ(all.constraints.borders[0].points, named.constraints.borders[0].points);
}

TEST(NameContacts, says_which_text_is_wrong_and_why) {
  const TriangleSoup raw = raw_box(0.25, 3);
  const auto why = [&](const std::string& text) {
    const Result<FoundContacts> found = name_contacts(raw, {text}, FindContactsOptions{});
    EXPECT_FALSE(found) << text;
    return found ? std::string() : found.failure().what;
  };
  EXPECT_EQ(why("H1 F1"), "contact \"H1 F1\": not of the form \"H2 -> F3 within 25\"");
  EXPECT_EQ(why("H1 -> F1 within far"), "contact \"H1 -> F1 within far\": not of the form \"H2 -> F3 within 25\"");
  EXPECT_EQ(why("H7 -> F1"), "contact \"H7 -> F1\": no surface is called H7");
  EXPECT_EQ(why("F1.border 9 -> box"), "contact \"F1.border 9 -> box\": F1 has 4 borders");
  EXPECT_EQ(why("H1 -> F1 within 0.1"), "contact \"H1 -> F1 within 0.1\": no border of H1 lies there and faces it");
  EXPECT_EQ(why("H1.stone -> F1.border"), "contact \"H1.stone -> F1.border\": no end of a contact of H1 is there");
  EXPECT_EQ(why("H1 -> H1"), "contact \"H1 -> H1\": not of the form \"H2 -> F3 within 25\"");
}

}  // namespace
}  // namespace strataflow
