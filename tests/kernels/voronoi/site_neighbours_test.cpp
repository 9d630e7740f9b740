#include "kernels/voronoi/site_neighbours.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "kernels/voronoi/diagram_samples.h"

namespace strataflow {
namespace {

TEST(SiteNeighbours, lists_are_the_nearest_by_distance) {
  const auto sites = sample::random_sites(200, 1, {0, 0, 0}, {1, 1, 1});
  SiteNeighbours neighbours;
  neighbours.move_to(sites);
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    std::vector<double> all;
    for (std::uint32_t j = 0; j < sites.size(); ++j)
      if (j != i) all.push_back(length(sites[i] - sites[j]));
    std::sort(all.begin(), all.end());
    const auto near = neighbours.near(i);
    for (std::size_t k = 0; k < near.size(); ++k) EXPECT_NEAR(near[k].distance, all[k], 1e-12);
  }
}

TEST(SiteNeighbours, lists_outlive_small_moves_and_bound_distances_by_the_slack) {
  auto sites = sample::random_sites(300, 2, {0, 0, 0}, {1, 1, 0});
  SiteNeighbours neighbours;
  neighbours.move_to(sites);
  for (Vec3& s : sites) s.x += 1e-3 * (s.y > 0.5 ? 1 : -1);
  neighbours.move_to(sites);
  EXPECT_GT(neighbours.slack(), 0);
  for (std::uint32_t i = 0; i < sites.size(); ++i)
    for (const NearSite& other : neighbours.near(i))
      EXPECT_GE(length(sites[i] - sites[other.site]), other.distance - neighbours.slack());
}

TEST(SiteNeighbours, lists_are_made_anew_after_large_moves) {
  auto sites = sample::random_sites(100, 3, {0, 0, 0}, {1, 1, 0});
  SiteNeighbours neighbours;
  neighbours.move_to(sites);
  for (Vec3& s : sites) s = {s.y, s.x, 0.3};
  neighbours.move_to(sites);
  EXPECT_EQ(neighbours.slack(), 0);
}

TEST(SiteNeighbours, a_search_within_a_radius_misses_no_site_that_moved) {
  auto sites = sample::random_sites(300, 4, {0, 0, 0}, {1, 1, 1});
  SiteNeighbours neighbours;
  neighbours.move_to(sites);
  for (Vec3& s : sites) s.z += 5e-4;
  neighbours.move_to(sites);
  std::vector<NearSite> found;
  for (std::uint32_t i = 0; i < sites.size(); i += 7) {
    neighbours.find_within(i, 0.3, found);
    std::set<std::uint32_t> ids;
    for (const NearSite& other : found) ids.insert(other.site);
    for (std::uint32_t j = 0; j < sites.size(); ++j) {
      if (j != i && length(sites[i] - sites[j]) <= 0.3) { EXPECT_TRUE(ids.count(j)); }
    }
    EXPECT_FALSE(ids.count(i));
  }
}

TEST(SiteNeighbours, sites_at_one_place_are_each_others_neighbours) {
  SiteNeighbours neighbours;
  neighbours.move_to(std::vector<Vec3>(40, Vec3{1, 2, 3}));
  for (std::uint32_t i = 0; i < 40; ++i)
    for (const NearSite& other : neighbours.near(i)) {
      EXPECT_NE(other.site, i);
      EXPECT_EQ(other.distance, 0);
    }
}

TEST(SiteNeighbours, one_site_has_no_neighbours) {
  SiteNeighbours neighbours;
  neighbours.move_to({{1, 1, 1}});
  EXPECT_TRUE(neighbours.lists_hold_all());
  EXPECT_TRUE(neighbours.near(0).empty());
}

}  // namespace
}  // namespace strataflow
