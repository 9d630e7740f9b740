#pragma once
#include <cstdint>
#include <vector>

namespace strataflow {

/// a + b·i with integers.
struct GaussianInteger {
  std::int64_t re = 0, im = 0;
  friend constexpr bool operator==(const GaussianInteger&, const GaussianInteger&) = default;
};
constexpr GaussianInteger operator+(GaussianInteger a, GaussianInteger b) { return {a.re + b.re, a.im + b.im}; }
constexpr GaussianInteger operator-(GaussianInteger a, GaussianInteger b) { return {a.re - b.re, a.im - b.im}; }
constexpr GaussianInteger operator-(GaussianInteger a) { return {-a.re, -a.im}; }
constexpr GaussianInteger operator*(GaussianInteger a, GaussianInteger b) {
  return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
constexpr GaussianInteger conj(GaussianInteger a) { return {a.re, -a.im}; }
/// i to the power of `turns`, times z.
constexpr GaussianInteger turned(GaussianInteger z, int turns) {
  switch (turns & 3) {
    case 1:
      return {-z.im, z.re};
    case 2:
      return {-z.re, -z.im};
    case 3:
      return {z.im, -z.re};
    default:
      return z;
  }
}
/// Re a · Im b − Im a · Re b: twice the signed area of the triangle (0, a, b).
constexpr std::int64_t cross(GaussianInteger a, GaussianInteger b) { return a.re * b.im - a.im * b.re; }

/// coefficient · U[corner]; a corner at or above 3·triangles is an auxiliary unknown, free: the offset Y of a point that
/// the decimated mesh kept although nothing makes it an integer (coudert2024 formula (4.12)).
struct IntegerTerm {
  std::uint32_t corner = 0;
  GaussianInteger coefficient;
};

/// Σ terms = value, as complex numbers: what quantization asks of the final map (A·U = ω, and the pin).
struct IntegerConstraint {
  std::vector<IntegerTerm> terms;
  GaussianInteger value;
};

}  // namespace strataflow
