#include "kernels/hexes/multigrid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "kernels/hexes/conjugate_gradients.h"
#include "kernels/hexes/gather_entries.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

/// Springs between neighbours of a cube of n³ nodes, each also held a little; `wide` times stiffer along z.
std::vector<MatrixEntry> cube(std::uint32_t n, double wide = 1) {
  std::vector<MatrixEntry> lower;
  for (std::uint32_t i = 0; i < n * n * n; ++i) {
    lower.push_back({i, i, 1e-6});
    const auto join = [&](std::uint32_t j, double k) { lower.insert(lower.end(), {{i, i, k}, {j, j, k}, {i, j, -k}}); };
    if (i % n > 0) join(i - 1, 1);
    if (i / n % n > 0) join(i - n, 1);
    if (i >= n * n) join(i - n * n, wide);
  }
  return lower;
}

double inner(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

std::vector<double> uneven(std::size_t size, std::size_t prime) {
  std::vector<double> v(size);
  for (std::size_t i = 0; i < size; ++i) v[i] = double(i * i % prime) - 0.5 * double(prime);
  return v;
}

TEST(SymmetricRows, sum_up_what_is_given_at_one_place) {
  const SparseRows rows =
      symmetric_rows(3, {{0, 0, 1}, {0, 0, 1}, {1, 1, 1}, {1, 0, -1}, {1, 1, 1}, {2, 2, 1}, {2, 1, -1}});
  EXPECT_EQ(rows.first, (std::vector<std::uint32_t>{0, 2, 5, 7}));
  EXPECT_EQ(rows.columns, (std::vector<std::uint32_t>{0, 1, 0, 1, 2, 1, 2}));
  EXPECT_EQ(rows.values, (std::vector<double>{2, -1, -1, 2, -1, -1, 1}));
}

TEST(SymmetricRows, of_many_bands_sum_each_place_in_the_order_given) {
  // 1 − 1 + 2⁻⁶⁰ + 2⁻⁶⁰ in this order alone keeps the small ones.
  constexpr std::uint32_t size = 70000;
  const std::vector<MatrixEntry> lower = gather_entries(size, [](std::size_t i, std::vector<MatrixEntry>& entries) {
    const auto row = static_cast<std::uint32_t>(i);
    for (const double value : {1.0, -1.0, 0x1p-60, 0x1p-60}) entries.push_back({row, row / 2, value});
  });
  ASSERT_EQ(lower.size(), 4u * size);
  for (std::uint32_t e = 0; e < lower.size(); ++e) ASSERT_EQ(lower[e].row, e / 4);
  support::on_every_schedule([&](const char* schedule) {
    const SparseRows rows = symmetric_rows(size, lower);
    ASSERT_EQ(rows.columns.size(), 2u * size - 1) << schedule;
    for (const std::uint32_t row : {2u, 5u, 34999u, 35000u, size - 1})
      EXPECT_EQ(rows.columns[rows.first[row]], row / 2) << schedule;
    for (const double value : rows.values) ASSERT_EQ(value, 0x1p-59) << schedule;
  });
}

TEST(Multigrid, is_the_inverse_of_a_small_matrix) {
  const Multigrid guide(symmetric_rows(27, cube(3)), constant_mode(27));
  const std::vector<double> b = uneven(27, 13);
  std::vector<double> back;
  multiply(guide.matrix(), guide(b), back);
  for (std::size_t i = 0; i < 27; ++i) EXPECT_NEAR(back[i], b[i], 1e-6);
}

TEST(Multigrid, is_linear_symmetric_and_positive) {
  constexpr std::uint32_t size = 14 * 14 * 14;
  const Multigrid guide(symmetric_rows(size, cube(14, 20)), constant_mode(size));
  const std::vector<double> a = uneven(size, 97), b = uneven(size, 31), of_a = guide(a), of_b = guide(b);
  EXPECT_NEAR(inner(of_a, b), inner(a, of_b), 1e-9 * std::abs(inner(a, of_a)));
  EXPECT_GT(inner(a, of_a), 0);
  EXPECT_GT(inner(b, of_b), 0);
  std::vector<double> sum(size);
  for (std::size_t i = 0; i < size; ++i) sum[i] = a[i] + 2 * b[i];
  const std::vector<double> of_sum = guide(sum);
  const double scale = std::sqrt(inner(of_sum, of_sum));
  for (std::size_t i = 0; i < size; ++i) EXPECT_NEAR(of_sum[i], of_a[i] + 2 * of_b[i], 1e-10 * scale);
}

/// Eight times the unknowns, nearly the same steps: without a guide they would double.
TEST(Multigrid, guides_to_the_solution_in_few_steps_whatever_the_size) {
  const auto steps = [](std::uint32_t n) {
    const std::uint32_t size = n * n * n;
    const Multigrid guide(symmetric_rows(size, cube(n)), constant_mode(size));
    std::vector<double> x(size, 0);
    return conjugate_gradients(guide, uneven(size, 97), x, 1e-8, 200);
  };
  const std::size_t coarse = steps(16), fine = steps(32);
  EXPECT_LE(coarse, 20u);
  EXPECT_LE(fine, coarse + 5);
}

/// Two unknowns a node, turned differently at each, some held to one direction: what is soft are the two directions.
TEST(Multigrid, knows_two_modes_in_turned_axes) {
  constexpr std::uint32_t n = 4000;
  SoftModes modes{{0}, {}, 2};
  std::vector<std::array<double, 2>> axes;
  for (std::uint32_t node = 0; node < n; ++node) {
    const double angle = 0.37 * node;
    axes.push_back({std::cos(angle), std::sin(angle)});
    if (node % 100 != 0) axes.push_back({-std::sin(angle), std::cos(angle)});
    modes.first.push_back(static_cast<std::uint32_t>(axes.size()));
  }
  modes.of_unknown = axes;
  std::vector<MatrixEntry> lower;
  for (std::uint32_t i = 0; i < axes.size(); ++i) lower.push_back({i, i, 1e-6});
  for (std::uint32_t node = 0; node + 1 < n; ++node)
    for (std::uint32_t i = modes.first[node]; i < modes.first[node + 2]; ++i)
      for (std::uint32_t j = modes.first[node]; j <= i; ++j) {
        const bool is_same = (i < modes.first[node + 1]) == (j < modes.first[node + 1]);
        lower.push_back({i, j, (is_same ? 1 : -1) * (axes[i][0] * axes[j][0] + axes[i][1] * axes[j][1])});
      }
  const auto size = static_cast<std::uint32_t>(axes.size());
  std::vector<double> b(size), x(size, 0), plain(size, 0);
  for (std::uint32_t i = 0; i < size; ++i) b[i] = axes[i][0];  // all pulled along x
  const std::size_t steps = conjugate_gradients({symmetric_rows(size, lower), std::move(modes)}, b, x, 1e-8, 2000);
  EXPECT_LE(steps, 40u);
  EXPECT_GT(conjugate_gradients({symmetric_rows(size, lower), constant_mode(size)}, b, plain, 1e-8, 2000), 2 * steps);
}

TEST(Multigrid, has_the_same_bits_on_every_schedule) {
  constexpr std::uint32_t size = 24 * 24 * 24;
  const std::vector<double> b = uneven(size, 97);
  const std::vector<double> expected = Multigrid(symmetric_rows(size, cube(24)), constant_mode(size))(b);
  support::on_every_schedule([&](const char* schedule) {
    EXPECT_EQ(Multigrid(symmetric_rows(size, cube(24)), constant_mode(size))(b), expected) << schedule;
  });
}

}  // namespace
}  // namespace strataflow
