#include "kernels/quads/field/spherical_harmonics.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace strataflow {

namespace {

constexpr double pi = std::numbers::pi;
const double a2 = 0.5 * std::sqrt(15 / pi), b2 = 0.25 * std::sqrt(5 / pi), c2 = 0.25 * std::sqrt(15 / pi);
const double a4 = 0.75 * std::sqrt(35 / pi), b4 = 0.75 * std::sqrt(35 / (2 * pi)), c4 = 0.75 * std::sqrt(5 / pi);
const double d4 = 0.75 * std::sqrt(5 / (2 * pi)), e4 = 3.0 / 16 * std::sqrt(1 / pi), f4 = 3.0 / 8 * std::sqrt(5 / pi);
const double g4 = 3.0 / 16 * std::sqrt(35 / pi);

/// A number and its derivatives by x, y and z.
struct Dual {
  double value = 0;
  Vec3 gradient;
};
Dual operator+(const Dual& a, const Dual& b) { return {a.value + b.value, a.gradient + b.gradient}; }
Dual operator-(const Dual& a, const Dual& b) { return {a.value - b.value, a.gradient - b.gradient}; }
Dual operator*(const Dual& a, const Dual& b) {
  return {a.value * b.value, b.value * a.gradient + a.value * b.gradient};
}
Dual operator*(double s, const Dual& a) { return {s * a.value, s * a.gradient}; }

template <class T>
std::array<T, 5> band_2(const T& x, const T& y, const T& z) {
  return {a2 * (x * y), a2 * (y * z), b2 * (2.0 * (z * z) - x * x - y * y), a2 * (x * z), c2 * (x * x - y * y)};
}

template <class T>
std::array<T, 9> band_4(const T& x, const T& y, const T& z) {
  const T xx = x * x, yy = y * y, zz = z * z, rr = xx + yy + zz;
  return {a4 * (x * y * (xx - yy)),
          b4 * (y * z * (3.0 * xx - yy)),
          c4 * (x * y * (7.0 * zz - rr)),
          d4 * (y * z * (7.0 * zz - 3.0 * rr)),
          e4 * (35.0 * (zz * zz) - 30.0 * (zz * rr) + 3.0 * (rr * rr)),
          d4 * (x * z * (7.0 * zz - 3.0 * rr)),
          f4 * ((xx - yy) * (7.0 * zz - rr)),
          b4 * (x * z * (xx - 3.0 * yy)),
          g4 * (xx * (xx - 3.0 * yy) - yy * (3.0 * xx - yy))};
}

template <std::size_t count>
std::array<Vec3, count> gradients(const std::array<Dual, count>& duals) {
  std::array<Vec3, count> all;
  for (std::size_t i = 0; i < count; ++i) all[i] = duals[i].gradient;
  return all;
}

Dual variable(double value, const Vec3& direction) { return {value, direction}; }

}  // namespace

std::array<double, 5> harmonics_2(const Vec3& u) { return band_2(u.x, u.y, u.z); }
std::array<double, 9> harmonics_4(const Vec3& u) { return band_4(u.x, u.y, u.z); }

std::array<Vec3, 5> harmonics_2_gradient(const Vec3& u) {
  return gradients(band_2(variable(u.x, {1, 0, 0}), variable(u.y, {0, 1, 0}), variable(u.z, {0, 0, 1})));
}
std::array<Vec3, 9> harmonics_4_gradient(const Vec3& u) {
  return gradients(band_4(variable(u.x, {1, 0, 0}), variable(u.y, {0, 1, 0}), variable(u.z, {0, 0, 1})));
}

}  // namespace strataflow
