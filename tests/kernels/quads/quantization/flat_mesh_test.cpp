#include "kernels/quads/quantization/flat_mesh.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

GaussianInteger coefficient(const LinearForm& form, std::uint32_t variable) {
  for (const LinearTerm& term : form)
    if (term.variable == variable) return term.coefficient;
  return {};
}

TEST(FlatMesh, quarters_hold_the_axis_that_they_start_with) {
  EXPECT_EQ(quadrant({3, 0}), 0);
  EXPECT_EQ(quadrant({0, 3}), 1);
  EXPECT_EQ(quadrant({-3, 0}), 2);
  EXPECT_EQ(quadrant({0, -3}), 3);
  EXPECT_EQ(quadrant({-1, -5}), 2);
  EXPECT_EQ(cross_sign({std::int64_t{1} << 61, 1}, {-1, std::int64_t{1} << 61}), 1) << "does not overflow";
}

TEST(FlatMesh, forms_add_up_and_cancel) {
  const LinearForm a{{1, {1, 0}}, {4, {0, 2}}}, b{{1, {0, 1}}, {2, {5, 0}}};
  const LinearForm sum = combine(a, 0, b, 1);  // a + i·b
  ASSERT_EQ(sum.size(), 2u) << "1 + i·i = 0 drops out";
  EXPECT_EQ(coefficient(sum, 2), (GaussianInteger{0, 5}));
  EXPECT_EQ(coefficient(sum, 4), (GaussianInteger{0, 2}));
}

// T21, Fig. 4.5 of coudert2024: U_l = U_i, U_m = U_k − i(U_j − U_k), U_n = U_k.
TEST(FlatMesh, the_worked_example_of_the_source_adds_up) {
  constexpr std::uint32_t i = 0, j = 1, k = 2;
  const LinearForm l{{i, {1, 0}}}, m{{j, {0, -1}}, {k, {1, 1}}}, n{{k, {1, 0}}};
  const LinearForm at_l = combine(m, 0, l, 2), at_m = combine(n, 0, m, 2), at_n = combine(l, 0, n, 2);
  const GaussianInteger omega_l{0, 4}, omega_m{-1, -2}, omega_n{1, -2};
  EXPECT_EQ(omega_l + omega_m + omega_n, GaussianInteger{});
  EXPECT_TRUE(combine(combine(at_l, 0, at_m, 0), 0, at_n, 0).empty());
  EXPECT_EQ(coefficient(at_m, j), (GaussianInteger{0, 1}));
  EXPECT_EQ(coefficient(at_m, k), (GaussianInteger{0, -1}));
  // i(U_j − U_k) = −1 − 2i gives U_j − U_k = −2 + i; the three values then satisfy all three constraints.
  const GaussianInteger u_k{7, -3}, u_j = u_k + GaussianInteger{-2, 1}, u_i = u_k + omega_n;
  const auto value = [&](const LinearForm& form) {
    return coefficient(form, i) * u_i + coefficient(form, j) * u_j + coefficient(form, k) * u_k;
  };
  EXPECT_EQ(value(at_l), omega_l);
  EXPECT_EQ(value(at_m), omega_m);
  EXPECT_EQ(value(at_n), omega_n);
}

}  // namespace
}  // namespace strataflow
