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

Multigrid guide_of(std::uint32_t size) { return {symmetric_rows(size, chain(size)), constant_mode(size)}; }

/// What pulls the end of the chain alone stretches each spring by one.
TEST(ConjugateGradients, stretch_a_chain_evenly) {
  constexpr std::uint32_t size = 5000;
  std::vector<double> b(size, 0), x(size, 0);
  b.back() = 1;
  EXPECT_LE(conjugate_gradients(guide_of(size), b, x, 1e-12, 100), 30u);
  for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(x[i], double(i + 1), 1e-6);
}

TEST(ConjugateGradients, need_no_step_from_the_solution) {
  const auto exact = solve_symmetric(5, chain(5), {{1, -2, 3, 0.5, 7}});
  ASSERT_TRUE(exact);
  std::vector<double> x = exact->front();
  EXPECT_EQ(conjugate_gradients(guide_of(5), {1, -2, 3, 0.5, 7}, x, 1e-12, 100), 0u);
}

TEST(ConjugateGradients, stop_after_the_steps_they_are_given) {
  std::vector<double> x(5000, 0);
  EXPECT_EQ(conjugate_gradients(guide_of(5000), std::vector<double>(5000, 1), x, 1e-12, 3), 3u);
}

TEST(SolveSymmetric, finds_the_same_by_multigrid_as_by_factors_and_from_any_start) {
  for (const std::uint32_t size : {1999u, 2001u}) {  // the limit is 2000
    std::vector<double> b(size, 0);
    b.back() = 2;
    for (const double start : {0.0, 7.0}) {
      const auto x = solve_symmetric(size, chain(size), {b}, {std::vector<double>(size, start)});
      ASSERT_TRUE(x);
      EXPECT_NEAR(x->front().back(), 2.0 * size, 1e-6);
    }
  }
}

TEST(SolveSymmetric, refuses_what_has_no_solution) {
  std::vector<MatrixEntry> loose = chain(6);
  loose[0].value = 0;  // nothing held
  EXPECT_FALSE(solve_symmetric(6, loose, {std::vector<double>(6, 1)}));
  std::vector<MatrixEntry> torn = chain(3000);
  torn[0].value = 0;
  EXPECT_FALSE(solve_symmetric(3000, torn, {std::vector<double>(3000, 1)}));
}

TEST(ConjugateGradients, have_the_same_bits_on_every_schedule) {
  const Multigrid guide = guide_of(20000);
  std::vector<double> b(20000);
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = std::sqrt(double(i % 97));
  std::vector<double> expected(20000, 0);
  conjugate_gradients(guide, b, expected, 1e-12, 40);
  support::on_every_schedule([&](const char* schedule) {
    std::vector<double> x(20000, 0);
    conjugate_gradients(guide, b, x, 1e-12, 40);
    EXPECT_EQ(x, expected) << schedule;
  });
}

}  // namespace
}  // namespace strataflow
