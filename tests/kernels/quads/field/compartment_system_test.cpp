#include "kernels/quads/field/compartment_system.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/seed.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

struct Matrix {
  std::vector<std::uint32_t> starts, rows;
  std::vector<double> values;
};

/// Chains of unknowns 0, k, 2k, …; 1, 1 + k, …: `chains` blocks woven into each other.
Matrix woven(std::uint32_t size, std::uint32_t chains) {
  Matrix m;
  PatternBuilder builder(size);
  for (std::uint32_t i = 0; i + chains < size; ++i) builder.add(i, i + chains);
  std::vector<std::uint32_t> slots;
  builder.finish(m.starts, m.rows, slots);
  m.values.assign(m.rows.size(), 0.0);
  for (std::uint32_t i = 0; i < size; ++i) m.values[m.starts[i]] = 3 + i % 5;
  for (const std::uint32_t s : slots) m.values[s] = -1;
  return m;
}

TEST(CompartmentSystem, solves_blocks_as_one_system_would) {
  const Matrix m = woven(100, 7);
  RandomStream random(3);
  std::vector<double> b;
  for (int i = 0; i < 100; ++i) b.push_back(random.unit() - 0.5);
  auto whole = PatternSystem<double>::analyse(m.starts, m.rows);
  auto parts = CompartmentSystem<double>::analyse(m.starts, m.rows);
  ASSERT_TRUE(whole && parts);
  EXPECT_EQ(parts->compartment_count(), 7u);
  ASSERT_TRUE(whole->factorize(m.values));
  ASSERT_TRUE(parts->factorize(m.values));
  const auto x = whole->solve(b), y = parts->solve(b);
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_NEAR(x[i], y[i], 1e-14);
}

TEST(CompartmentSystem, is_the_same_bits_on_every_schedule_and_as_one_system_where_all_is_connected) {
  const Matrix m = woven(60, 1);
  std::vector<double> b(60, 1.0);
  auto whole = PatternSystem<double>::analyse(m.starts, m.rows);
  ASSERT_TRUE(whole && whole->factorize(m.values));
  const auto x = whole->solve(b);
  const Matrix woven_3 = woven(60, 3);
  std::vector<double> first;
  support::on_every_schedule([&](const char* schedule) {
    auto one = CompartmentSystem<double>::analyse(m.starts, m.rows);
    ASSERT_TRUE(one && one->factorize(m.values));
    EXPECT_EQ(one->solve(b), x) << schedule;
    auto three = CompartmentSystem<double>::analyse(woven_3.starts, woven_3.rows);
    ASSERT_TRUE(three && three->factorize(woven_3.values));
    if (first.empty()) first = three->solve(b);
    EXPECT_EQ(three->solve(b), first) << schedule;
  });
}

TEST(CompartmentSystem, tells_which_matrix_is_none) {
  EXPECT_FALSE(CompartmentSystem<double>::analyse({0, 1, 2}, {0, 7}));
  EXPECT_FALSE(CompartmentSystem<double>::analyse({0, 1, 3}, {0, 1}));
  Matrix m = woven(10, 2);
  auto system = CompartmentSystem<double>::analyse(m.starts, m.rows);
  ASSERT_TRUE(system);
  m.values[m.starts[3]] = std::nan("");
  EXPECT_EQ(system->factorize(m.values).failure().code, FailureCode::invalid_input);
}

}  // namespace
}  // namespace strataflow
