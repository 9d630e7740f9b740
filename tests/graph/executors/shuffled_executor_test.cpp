#include "graph/executors/shuffled_executor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace strataflow {
namespace {

/// 0 → 1, 2, 3 → 4
const TaskOrder fork_and_join{{0, 1, 1, 1, 3}, {{1, 2, 3}, {4}, {4}, {4}, {}}};

std::vector<std::size_t> order_of(std::uint64_t seed) {
  std::vector<std::size_t> seen;
  auto task = [&](std::size_t i) { seen.push_back(i); };
  run_tasks_shuffled(fork_and_join, seed, task);
  return seen;
}

TEST(ShuffledExecutor, every_order_the_edges_allow_comes_up_and_no_other) {
  std::set<std::vector<std::size_t>> orders;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const auto order = order_of(seed);
    ASSERT_EQ(order.size(), 5u);
    EXPECT_EQ(order.front(), 0u);
    EXPECT_EQ(order.back(), 4u);
    orders.insert(order);
  }
  EXPECT_EQ(orders.size(), 6u);
}

TEST(ShuffledExecutor, a_seed_always_gives_the_same_order) { EXPECT_EQ(order_of(7), order_of(7)); }

TEST(ShuffledExecutor, chunks_are_shuffled_and_each_runs_once) {
  std::vector<std::size_t> seen;
  auto task = [&](std::size_t) {
    auto chunk = [&](std::size_t j) { seen.push_back(j); };
    run_chunks(20, chunk);
  };
  run_tasks_shuffled({{0}, {{}}}, 3, task);
  EXPECT_FALSE(std::is_sorted(seen.begin(), seen.end()));
  EXPECT_EQ(std::set<std::size_t>(seen.begin(), seen.end()).size(), 20u);
  EXPECT_EQ(seen.size(), 20u);
}

}  // namespace
}  // namespace strataflow
