#include "kernels/quads/field/spherical_harmonics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/seed.h"

namespace strataflow {
namespace {

constexpr double pi = std::numbers::pi;

Vec3 random_unit(RandomStream& random) {
  const double z = 2 * random.unit() - 1, t = 2 * pi * random.unit(), r = std::sqrt(1 - z * z);
  return {r * std::cos(t), r * std::sin(t), z};
}

/// T16: by a product quadrature that is exact for polynomials of degree 8 (Gauss in z, equal steps around).
TEST(SphericalHarmonics, are_orthonormal) {
  const std::vector<std::pair<double, double>> gauss{{0, 0.3302393550012598},
                                                     {0.3242534234038089, 0.3123470770400029},
                                                     {0.6133714327005904, 0.2606106964029354},
                                                     {0.8360311073266358, 0.1806481606948574},
                                                     {0.9681602395076261, 0.0812743883615744}};
  std::array<std::array<double, 14>, 14> sums{};
  for (const auto& [at, weight] : gauss)
    for (const double z : at == 0 ? std::vector{0.0} : std::vector{at, -at})
      for (int k = 0; k < 12; ++k) {
        const double t = 2 * pi * k / 12, r = std::sqrt(1 - z * z);
        const Vec3 u{r * std::cos(t), r * std::sin(t), z};
        std::array<double, 14> all{};
        const auto second = harmonics_2(u);
        const auto fourth = harmonics_4(u);
        std::copy(second.begin(), second.end(), all.begin());
        std::copy(fourth.begin(), fourth.end(), all.begin() + 5);
        for (std::size_t i = 0; i < 14; ++i)
          for (std::size_t j = 0; j < 14; ++j) sums[i][j] += weight * 2 * pi / 12 * all[i] * all[j];
      }
  for (std::size_t i = 0; i < 14; ++i)
    for (std::size_t j = 0; j < 14; ++j) EXPECT_NEAR(sums[i][j], i == j, 5e-15);
}

/// T16: formulas (3.28) and (3.30).
TEST(SphericalHarmonics, hold_the_fourth_power_of_a_direction) {
  RandomStream random(1);
  for (int sample = 0; sample < 50; ++sample) {
    const Vec3 s = random_unit(random), u = random_unit(random);
    double sum = 63 / (4 * pi);
    for (std::size_t m = 0; m < 5; ++m) sum += 36 * harmonics_2(u)[m] * harmonics_2(s)[m];
    for (std::size_t m = 0; m < 9; ++m) sum += 8 * harmonics_4(u)[m] * harmonics_4(s)[m];
    EXPECT_NEAR(4 * pi / 315 * sum, std::pow(dot(u, s), 4), 1e-13);
    EXPECT_NEAR(2 * std::sqrt(pi) / 105 * (21 / std::sqrt(4 * pi) + 12 * std::sqrt(5.0) * harmonics_2(s)[2] + 8 * harmonics_4(s)[4]),
                std::pow(s.z, 4), 1e-13);
  }
}

TEST(SphericalHarmonics, of_band_two_vanish_for_crosses_and_only_for_them) {
  RandomStream random(2);
  const Vec3 u = random_unit(random), other = random_unit(random);
  const Vec3 v = (1 / length(cross(u, other))) * cross(u, other), w = cross(u, v);
  const auto norm = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    double sum = 0;
    for (std::size_t m = 0; m < 5; ++m) sum += std::pow(harmonics_2(a)[m] + harmonics_2(b)[m] + harmonics_2(c)[m], 2);
    return sum;
  };
  EXPECT_LT(norm(u, v, w), 1e-28);
  EXPECT_GT(norm(u, v, other), 1e-3);
}

TEST(SphericalHarmonics, have_the_gradients_of_their_differences) {
  RandomStream random(3);
  const Vec3 u = 1.3 * random_unit(random);
  constexpr double h = 1e-6;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 up = u, down = u;
    up[axis] += h;
    down[axis] -= h;
    for (std::size_t m = 0; m < 5; ++m)
      EXPECT_NEAR(harmonics_2_gradient(u)[m][axis], (harmonics_2(up)[m] - harmonics_2(down)[m]) / (2 * h), 1e-8);
    for (std::size_t m = 0; m < 9; ++m)
      EXPECT_NEAR(harmonics_4_gradient(u)[m][axis], (harmonics_4(up)[m] - harmonics_4(down)[m]) / (2 * h), 1e-7);
  }
}

}  // namespace
}  // namespace strataflow
