#pragma once
#include <cmath>
#include <limits>

namespace strataflow {

/// A number of about 106 bits, hi + lo, with a bound on how far it is from the true one (Dekker 1971; the bound is
/// carried along operation by operation). An infinite bound means "ask exact arithmetic".
struct BoundedDouble {
  double hi = 0, lo = 0;
  double error = 0;

  BoundedDouble() = default;
  BoundedDouble(double value) : hi(value) {}
  BoundedDouble(double high, double low, double bound) : hi(high), lo(low), error(bound) {}
};

namespace double_double {

constexpr double roundoff = 0x1.0p-100;  ///< generous: each operation is good to about 2^-103
constexpr double floor = 1e-280;         ///< below this the error terms of products may underflow

inline BoundedDouble renormalized(double hi, double lo, double error) {
  const double sum = hi + lo;
  return {sum, lo - (sum - hi), error};
}

struct Sum {
  double value, rest;
};
inline Sum two_sum(double a, double b) {
  const double s = a + b, bb = s - a;
  return {s, (a - (s - bb)) + (b - bb)};
}
inline Sum two_product(double a, double b) {
  const double product = a * b;
  const double ca = 134217729.0 * a, cb = 134217729.0 * b;  // 2^27 + 1
  const double ah = ca - (ca - a), al = a - ah, bh = cb - (cb - b), bl = b - bh;
  return {product, ((ah * bh - product) + ah * bl + al * bh) + al * bl};
}

}  // namespace double_double

inline BoundedDouble operator-(const BoundedDouble& a) { return {-a.hi, -a.lo, a.error}; }

inline BoundedDouble operator+(const BoundedDouble& a, const BoundedDouble& b) {
  auto [s, e] = double_double::two_sum(a.hi, b.hi);
  const auto [t, f] = double_double::two_sum(a.lo, b.lo);
  e += t;
  const double hi = s + e;
  e = e - (hi - s) + f;
  BoundedDouble sum = double_double::renormalized(hi, e, 0);
  sum.error = (a.error + b.error) * (1 + 1e-10) + double_double::roundoff * std::abs(sum.hi);
  // Two plain doubles add without error.
  if (a.lo == 0 && b.lo == 0 && a.error == 0 && b.error == 0) sum.error = 0;
  return sum;
}

inline BoundedDouble operator-(const BoundedDouble& a, const BoundedDouble& b) { return a + (-b); }

inline BoundedDouble operator*(const BoundedDouble& a, const BoundedDouble& b) {
  if ((a.hi == 0 && a.error == 0) || (b.hi == 0 && b.error == 0)) return {};
  auto [p, e] = double_double::two_product(a.hi, b.hi);
  e += a.hi * b.lo + a.lo * b.hi;
  BoundedDouble product = double_double::renormalized(p, e, 0);
  product.error = (std::abs(a.hi) * b.error + std::abs(b.hi) * a.error + a.error * b.error) * (1 + 1e-10) +
                  double_double::roundoff * std::abs(p) + double_double::floor;
  return product;
}

/// An infinite bound when the divisor may be 0.
inline BoundedDouble operator/(const BoundedDouble& a, const BoundedDouble& b) {
  if (a.hi == 0 && a.error == 0 && std::abs(b.hi) > 2 * b.error) return {};
  const double q1 = a.hi / b.hi;
  const BoundedDouble exact_b{b.hi, b.lo, 0};
  BoundedDouble r = BoundedDouble{a.hi, a.lo, 0} - exact_b * q1;
  const double q2 = r.hi / b.hi;
  r = r - exact_b * q2;
  const double q3 = r.hi / b.hi;
  const BoundedDouble sum = BoundedDouble(q1) + BoundedDouble(q2) + BoundedDouble(q3);
  const double room = std::abs(b.hi) - 2 * b.error;
  const double bound = !(room > 0) || !std::isfinite(q1)
                           ? std::numeric_limits<double>::infinity()
                           : (a.error + std::abs(q1) * 2 * b.error) / room * (1 + 1e-10) +
                                 64 * double_double::roundoff * std::abs(q1) + double_double::floor / room;
  return {sum.hi, sum.lo, bound};
}

/// Whether the nearest double of the true number is certain, and then which (`hi`).
inline bool rounds_surely(const BoundedDouble& a) {
  const double error = a.error * (1 + 1e-10);
  return a.error == 0 ? a.hi + a.lo == a.hi : a.hi + (a.lo + error) == a.hi && a.hi + (a.lo - error) == a.hi;
}

}  // namespace strataflow
