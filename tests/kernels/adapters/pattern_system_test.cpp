#include "kernels/adapters/sparse/pattern_system.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

using Complex = std::complex<double>;

/// A path of `size` points: the pattern of its Laplacian, and per edge and diagonal where it is.
struct Path {
  std::vector<std::uint32_t> starts, rows, slots;
  explicit Path(std::uint32_t size) {
    PatternBuilder builder(size);
    for (std::uint32_t i = 0; i + 1 < size; ++i) builder.add(i, i + 1);
    builder.finish(starts, rows, slots);
  }
};

TEST(PatternSystem, is_analysed_once_and_factorised_as_often_as_the_values_change) {
  Path path(50);
  auto system = PatternSystem<double>::analyse(path.starts, path.rows);
  ASSERT_TRUE(system);
  for (const double middle : {2.5, 4.0}) {
    std::vector<double> values(path.rows.size(), -1.0), b(50, 1.0);
    for (std::uint32_t i = 0; i < 50; ++i) values[path.starts[i]] = middle;
    ASSERT_TRUE(system->factorize(values));
    const std::vector<double> x = system->solve(b);
    for (std::size_t i = 0; i < 50; ++i)
      EXPECT_NEAR(middle * x[i] - (i > 0 ? x[i - 1] : 0) - (i < 49 ? x[i + 1] : 0), 1, 1e-12);
  }
}

TEST(PatternSystem, solves_hermitian_systems) {
  Path path(20);
  auto system = PatternSystem<Complex>::analyse(path.starts, path.rows);
  ASSERT_TRUE(system);
  std::vector<Complex> values(path.rows.size(), Complex(0, 1));  // below the diagonal; its conjugate above
  for (std::uint32_t i = 0; i < 20; ++i) values[path.starts[i]] = 3;
  ASSERT_TRUE(system->factorize(values));
  std::vector<Complex> b(20);
  for (std::size_t i = 0; i < 20; ++i) b[i] = Complex(1.0 + static_cast<double>(i), -2);
  const std::vector<Complex> x = system->solve(b);
  for (std::size_t i = 0; i < 20; ++i) {
    const Complex row = 3.0 * x[i] + (i > 0 ? Complex(0, 1) * x[i - 1] : 0) + (i < 19 ? Complex(0, -1) * x[i + 1] : 0);
    EXPECT_NEAR(std::abs(row - b[i]), 0, 1e-12);
  }
}

TEST(PatternSystem, adds_up_entries_at_the_same_place) {
  PatternBuilder builder(3);
  builder.add(2, 0);
  builder.add(0, 2);
  builder.add(1, 1);
  std::vector<std::uint32_t> starts, rows, slots;
  builder.finish(starts, rows, slots);
  EXPECT_EQ(rows, (std::vector<std::uint32_t>{0, 2, 1, 2}));
  EXPECT_EQ(slots, (std::vector<std::uint32_t>{1, 1, 2}));
}

TEST(PatternSystem, refuses_indefinite_infinite_and_misshapen_matrices) {
  Path path(4);
  auto system = PatternSystem<double>::analyse(path.starts, path.rows);
  ASSERT_TRUE(system);
  std::vector<double> values(path.rows.size(), -1.0);
  EXPECT_EQ(system->factorize(values).failure().code, FailureCode::geometry_failed);
  values[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(system->factorize(values).failure().code, FailureCode::invalid_input);
  EXPECT_FALSE(PatternSystem<double>::analyse({0, 1, 2}, {0, 0}));
  EXPECT_FALSE(PatternSystem<double>::analyse({}, {}));
}

}  // namespace
}  // namespace strataflow
