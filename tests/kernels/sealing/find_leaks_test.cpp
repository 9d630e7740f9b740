#include "kernels/sealing/find_leaks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "kernels/contacts/raw_surfaces.h"

namespace strataflow {
namespace {

using testing::ElementsAre;
using testing::StartsWith;

std::set<std::string> texts(const std::vector<Leak>& leaks) {
  std::set<std::string> all;
  for (const Leak& leak : leaks) all.insert(leak.text.substr(0, leak.text.find(" at (")));
  return all;
}

TEST(FindLeaks, names_who_stops_how_far_short_of_what) {
  const std::vector<Leak> leaks = find_leaks(support::raw_box(0.5, 3), 0.1, 1.8);
  EXPECT_THAT(texts(leaks),
              ElementsAre(StartsWith("F1 stops 0.5 m short of box"), StartsWith("H1 stops 0.5 m short of F1"),
                          StartsWith("H1 stops 0.5 m short of box")));
  for (const Leak& leak : leaks) EXPECT_NEAR(leak.gap_m, 0.5, 1e-9);
}

TEST(FindLeaks, a_fault_may_die_where_it_is_beyond_three_tenths_of_the_search_distance) {
  EXPECT_THAT(texts(find_leaks(support::raw_box(0.5, 3), 0.1, 0.8)),
              ElementsAre(StartsWith("H1 stops 0.5 m short of F1"), StartsWith("H1 stops 0.5 m short of box")));
}

TEST(FindLeaks, surfaces_that_conform_do_not_leak_nor_do_those_that_end_far_away) {
  EXPECT_TRUE(find_leaks(support::layered_box({0, 1, 2}), 0.1, 0.5).empty());
  EXPECT_TRUE(find_leaks(support::raw_box(0.5, 9), 0.1, 0.3).empty());
}

TEST(FindLooseEntities, tells_what_touches_nothing) {
  EXPECT_THAT(find_loose_entities(support::box_with_floating_fault()), ElementsAre(0u, 1u));
  EXPECT_TRUE(find_loose_entities(support::layered_box({0, 1, 2})).empty());
  TriangleSoup soup = support::layered_box({0, 1, 2});
  support::add_sheet(soup, 1, {0.2, 0.2, 0}, {0.8, 0.8, 0}, 0.5);  // a second piece of H1, which touches nothing
  EXPECT_THAT(find_loose_entities(soup), ElementsAre(1u));
}

}  // namespace
}  // namespace strataflow
