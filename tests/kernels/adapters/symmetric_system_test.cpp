#include "kernels/adapters/sparse/symmetric_system.h"

#include <gtest/gtest.h>

#include "base/archive.h"
#include "base/digest.h"
#include "base/seed.h"

namespace strataflow {
namespace {

/// The five-point Laplacian of an n × n grid, plus one on the diagonal.
std::vector<MatrixEntry> grid_matrix(std::uint32_t n) {
  std::vector<MatrixEntry> lower;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t at = i * n + j;
      lower.push_back({at, at, 5.0});
      if (j > 0) lower.push_back({at, at - 1, -1.0});
      if (i > 0) lower.push_back({at, at - n, -1.0});
    }
  return lower;
}

std::vector<double> random_vector(std::size_t size) {
  RandomStream random(4);
  std::vector<double> b(size);
  for (double& x : b) x = random.unit() - 0.5;
  return b;
}

TEST(SymmetricSystem, solves_what_it_factorised) {
  constexpr std::uint32_t n = 30;
  const auto lower = grid_matrix(n);
  const auto system = SymmetricSystem::factorize(n * n, lower);
  ASSERT_TRUE(system);
  const std::vector<double> b = random_vector(n * n), x = system->solve(b);
  std::vector<double> residual = b;
  for (const MatrixEntry& e : lower) {
    residual[e.row] -= e.value * x[e.column];
    if (e.row != e.column) residual[e.column] -= e.value * x[e.row];
  }
  for (const double r : residual) EXPECT_NEAR(r, 0.0, 1e-13);
}

TEST(SymmetricSystem, gives_the_same_bits_whatever_blas_is_installed) {
  // The digest was taken with the reference BLAS; a method that calls BLAS would change it elsewhere.
  constexpr std::uint32_t n = 60;
  const auto system = SymmetricSystem::factorize(n * n, grid_matrix(n));
  ASSERT_TRUE(system);
  EXPECT_EQ(digest_of(archived(system->solve(random_vector(n * n)))).hex(), "13ab12df1f4660f6751bc6979e21a639");
}

TEST(SymmetricSystem, refuses_a_singular_matrix_and_entries_out_of_place) {
  const auto singular = SymmetricSystem::factorize(2, {{0, 0, 1.0}, {1, 0, 1.0}, {1, 1, 1.0}});
  ASSERT_FALSE(singular);
  EXPECT_EQ(singular.failure().code, FailureCode::geometry_failed);
  EXPECT_FALSE(SymmetricSystem::factorize(2, {{0, 1, 1.0}}));
  EXPECT_FALSE(SymmetricSystem::factorize(2, {{2, 0, 1.0}}));
}

}  // namespace
}  // namespace strataflow
