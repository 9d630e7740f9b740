#pragma once
#include <array>

#include "model/vector3.h"

namespace strataflow {

/// A symmetric matrix, as xx, yy, zz, xy, xz, yz.
using Symmetric3 = std::array<double, 6>;

/// The outer product a bᵀ + b aᵀ, halved, times a factor.
Symmetric3 outer_product(const Vec3& a, const Vec3& b, double factor);

/// Eigenvectors of length 1 by descending eigenvalue, by Jacobi rotations.
struct PrincipalAxes {
  std::array<Vec3, 3> axes;
  std::array<double, 3> values{};
};
PrincipalAxes principal_axes(const Symmetric3& matrix);

/// Mass, mean and spread of triangles (by area) or segments (by length), exact for both. Take points relative to one
/// of them, so that large coordinates do not eat the digits.
class MassMoments {
 public:
  void take_triangle(const Vec3& a, const Vec3& b, const Vec3& c);
  void take_segment(const Vec3& a, const Vec3& b);
  double mass() const { return mass_; }
  Vec3 centre() const { return mass_ > 0 ? (1 / mass_) * first_ : Vec3{}; }
  /// The axes along which the mass is spread most … least: the last one is the normal of the mean plane.
  PrincipalAxes axes() const;

 private:
  double mass_ = 0;
  Vec3 first_;
  Symmetric3 second_{};
};

}  // namespace strataflow
