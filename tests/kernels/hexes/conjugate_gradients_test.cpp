#include "kernels/hexes/conjugate_gradients.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/schedules.h"

namespace strataflow {
namespace {

/// A chain of springs with one end held: entry by entry, so that diagonals come in pieces.
std::vector<MatrixEntry> chain(std::uint32_t size) {
  std::vector<MatrixEntry> lower{{0, 0, 1}};
  for (std::uint32_t i = 0; i + 1 < size; ++i) {
    lower.push_back({i, i, 1});
    lower.push_back({i + 1, i + 1, 1});
    lower.push_back({i + 1, i, -1});
  }
  return lower;
}

TEST(ConjugateGradients, sums_up_what_is_given_at_one_place) {
  const SymmetricRows rows = symmetric_rows(3, chain(3));
  EXPECT_EQ(rows.first, (std::vector<std::uint32_t>{0, 2, 5, 7}));
  EXPECT_EQ(rows.columns, (std::vector<std::uint32_t>{0, 1, 0, 1, 2, 1, 2}));
  EXPECT_EQ(rows.values, (std::vector<double>{2, -1, -1, 2, -1, -1, 1}));
}

TEST(ConjugateGradients, solve_what_a_factorisation_solves) {
  const std::vector<double> b{1, -2, 3, 0.5, 7};
  std::vector<double> x(5, 0);
  EXPECT_LE(conjugate_gradients(symmetric_rows(5, chain(5)), b, x, 1e-12, 100), 6u);
  const auto exact = solve_symmetric(5, chain(5), {b});
  ASSERT_TRUE(exact);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(x[i], (*exact)[0][i], 1e-9);
}

TEST(ConjugateGradients, stop_after_the_steps_they_are_given) {
  std::vector<double> x(50, 0);
  EXPECT_EQ(conjugate_gradients(symmetric_rows(50, chain(50)), std::vector<double>(50, 1), x, 1e-12, 3), 3u);
}

TEST(ConjugateGradients, have_the_same_bits_on_every_schedule) {
  const SymmetricRows rows = symmetric_rows(20000, chain(20000));
  std::vector<double> b(20000);
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = std::sqrt(double(i % 97));
  std::vector<double> expected(20000, 0);
  conjugate_gradients(rows, b, expected, 1e-12, 40);
  support::on_every_schedule([&](const char* schedule) {
    std::vector<double> x(20000, 0);
    conjugate_gradients(rows, b, x, 1e-12, 40);
    EXPECT_EQ(x, expected) << schedule;
  });
}

}  // namespace
}  // namespace strataflow
