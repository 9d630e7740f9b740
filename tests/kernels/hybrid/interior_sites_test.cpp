#include "kernels/hybrid/interior_sites.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/archive.h"
#include "filled_block.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

TEST(InteriorSiteCount, is_what_the_edges_of_the_boundary_ask_for) {
  support::FilledBlock block({6, 6, 6});
  ASSERT_TRUE(block.take_fan({3, 3, 3}));
  // Edges of 1, 1 and √2, most points of three such pairs: cells of 0.7 · 1.14³. The 218 points of the boundary have
  // 150 halves, 60 quarters and 8 eighths of a cell.
  const double cells = 216 / (0.7 * std::pow((2 + std::sqrt(2.0)) / 3, 3)), shares = 150 / 2.0 + 60 / 4.0 + 8 / 8.0;
  EXPECT_NEAR(interior_site_count(block.boundary, block.mesh), cells - shares, 0.03 * cells);
}

TEST(InteriorSiteCount, is_none_where_the_region_is_as_thin_as_a_cell) {
  support::FilledBlock block({5, 5, 1});
  ASSERT_TRUE(block.take_fan({2.5, 2.5, 0.5}));
  EXPECT_EQ(interior_site_count(block.boundary, block.mesh), 0);
}

TEST(SpreadInteriorSites, are_as_many_as_asked_for_inside_and_as_far_apart_as_the_boundary) {
  support::FilledBlock block({5, 5, 5});
  ASSERT_TRUE(block.take_fan({2.5, 2.5, 2.5}));
  const std::size_t count = 70;
  const auto nearest = [&](const std::vector<Vec3>& sites) {  // the smallest distance of a site to any other point
    double least = 100;
    for (std::size_t i = 0; i < sites.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) least = std::min(least, length(sites[i] - sites[j]));
      for (const Vec3& p : block.boundary.coordinates) least = std::min(least, length(sites[i] - p));
    }
    return least;
  };
  const std::vector<Vec3> drawn = spread_interior_sites(block.boundary, block.mesh, count, 0);
  const std::vector<Vec3> spread = spread_interior_sites(block.boundary, block.mesh, count, 15);
  ASSERT_EQ(spread.size(), count);
  for (const Vec3& p : spread) {
    EXPECT_GT(std::min({p.x, p.y, p.z}), 0.2);
    EXPECT_LT(std::max({p.x, p.y, p.z}), 4.8);
  }
  EXPECT_GT(nearest(spread), 0.6);
  EXPECT_GT(nearest(spread), 2 * nearest(drawn));
}

TEST(SpreadInteriorSites, crowd_where_the_boundary_is_fine) {
  // Squares of edge 1, but the points' first coordinate goes with the square: edges from 1 to 11 along x.
  support::FilledBlock block({6, 3, 3});
  for (Vec3& p : block.boundary.coordinates) {
    p.x *= p.x;
    p.y *= 4;
    p.z *= 4;
  }
  block.volume_m3 = 36 * 12 * 12;
  ASSERT_TRUE(block.take_fan({18, 6, 6}));
  const std::vector<Vec3> sites = spread_interior_sites(block.boundary, block.mesh, 40, 10);
  const auto in_first_half = std::count_if(sites.begin(), sites.end(), [](const Vec3& p) { return p.x < 18; });
  EXPECT_GT(in_first_half, 24);
}

TEST(SpreadInteriorSites, none_are_none) {
  support::FilledBlock block({2, 2, 2});
  ASSERT_TRUE(block.take_fan({1, 1, 1}));
  EXPECT_TRUE(spread_interior_sites(block.boundary, block.mesh, 0, 10).empty());
  EXPECT_TRUE(spread_interior_sites(block.boundary, {}, 5, 10).empty());
}

TEST(SpreadInteriorSites, are_the_same_on_every_schedule) {
  support::FilledBlock block({3, 4, 5});
  ASSERT_TRUE(block.take_fan({1.4, 2.1, 2.6}));
  const std::vector<Vec3> wanted = spread_interior_sites(block.boundary, block.mesh, 30, 4);
  support::on_every_schedule([&](const char* schedule) {
    EXPECT_EQ(archived(spread_interior_sites(block.boundary, block.mesh, 30, 4)), archived(wanted)) << schedule;
  });
}

}  // namespace
}  // namespace strataflow
