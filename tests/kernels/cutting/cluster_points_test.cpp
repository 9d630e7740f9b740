#include "kernels/cutting/cluster_points.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "base/seed.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

using Indices = std::vector<std::uint32_t>;

TEST(ClusterPoints, merges_what_is_within_the_tolerance) {
  const PointClusters clusters = cluster_points({{0, 0, 0}, {5, 0, 0}, {0.5, 0, 0}}, {}, 1);
  EXPECT_EQ(clusters.representative, (Indices{0, 1, 0}));
  EXPECT_EQ(clusters.merged_count, 1u);
  EXPECT_EQ(clusters.largest_move_m, 0.5);
}

TEST(ClusterPoints, leaves_all_as_they_are_without_a_tolerance) {
  EXPECT_EQ(cluster_points({{0, 0, 0}, {0, 0, 0}}, {}, 0).merged_count, 0u);
  EXPECT_EQ(cluster_points({}, {}, 1).merged_count, 0u);
}

TEST(ClusterPoints, does_not_drift_along_a_chain) {
  std::vector<Vec3> chain;
  for (int i = 0; i < 100; ++i) chain.push_back({0.9 * i, 0, 0});
  const PointClusters clusters = cluster_points(chain, {}, 1);
  for (std::uint32_t i = 0; i < chain.size(); ++i) EXPECT_LE(length(chain[i] - chain[clusters.representative[i]]), 1.0);
  EXPECT_EQ(clusters.merged_count, 50u);
  EXPECT_LE(clusters.largest_move_m, 1.0);
}

TEST(ClusterPoints, never_moves_fixed_points) {
  const PointClusters clusters = cluster_points({{0, 0, 0}, {0.1, 0, 0}, {0.06, 0, 0}, {1, 0, 0}}, {1, 1, 0, 0}, 0.5);
  EXPECT_EQ(clusters.representative, (Indices{0, 1, 1, 3}));
}

TEST(ClusterPoints, prefers_a_fixed_point_to_a_nearer_free_one) {
  EXPECT_EQ(cluster_points({{0, 0, 0}, {0.1, 0, 0}, {0.9, 0, 0}}, {0, 0, 1}, 1).representative, (Indices{2, 2, 2}));
}

TEST(ClusterPoints, breaks_ties_by_position) {
  EXPECT_EQ(cluster_points({{2, 0, 0}, {1, 0, 0}, {0, 0, 0}}, {1, 0, 1}, 1).representative, (Indices{0, 2, 2}));
}

std::vector<Vec3> cloud(std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < 2000; ++i) points.push_back({random.unit(), random.unit(), 0.1 * random.unit()});
  return points;
}

TEST(ClusterPoints, depends_neither_on_the_order_of_points_nor_on_the_schedule) {
  const std::vector<Vec3> points = cloud(1);
  std::vector<char> is_fixed(points.size(), 0);
  for (std::size_t i = 0; i < points.size(); i += 7) is_fixed[i] = 1;
  const PointClusters expected = cluster_points(points, is_fixed, 0.02);
  EXPECT_GT(expected.merged_count, 100u);
  EXPECT_LE(expected.largest_move_m, 0.02);
  support::on_every_schedule([&](const char* schedule) {
    EXPECT_EQ(cluster_points(points, is_fixed, 0.02).representative, expected.representative) << schedule;
  });
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    RandomStream random(seed);
    Indices order(points.size());
    std::iota(order.begin(), order.end(), 0u);
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
    std::vector<Vec3> shuffled;
    std::vector<char> shuffled_fixed;
    for (const std::uint32_t i : order) {
      shuffled.push_back(points[i]);
      shuffled_fixed.push_back(is_fixed[i]);
    }
    const PointClusters clusters = cluster_points(shuffled, shuffled_fixed, 0.02);
    for (std::size_t i = 0; i < order.size(); ++i)
      ASSERT_EQ(order[clusters.representative[i]], expected.representative[order[i]]);
  }
}

TEST(ClusterPoints, leaves_points_that_stay_further_apart_than_the_tolerance) {
  const std::vector<Vec3> points = cloud(2);
  const PointClusters clusters = cluster_points(points, {}, 0.02);
  const std::set<std::uint32_t> stay(clusters.representative.begin(), clusters.representative.end());
  for (const std::uint32_t a : stay) {
    EXPECT_EQ(clusters.representative[a], a);
    for (const std::uint32_t b : stay)
      if (a < b) {
        ASSERT_GT(length(points[a] - points[b]), 0.02);
      }
  }
}

}  // namespace
}  // namespace strataflow
