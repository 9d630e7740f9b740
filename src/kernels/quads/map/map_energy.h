#pragma once
#include <array>
#include <complex>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/result.h"
#include "kernels/adapters/sparse/pattern_system.h"
#include "kernels/quads/map/map_reduction.h"
#include "model/corner_map.h"

namespace strataflow {

/// The linear parts of a map on its triangles: U = p·z + q·conj(z) + constant, z the place in the triangle's own plane,
/// x along its first half-edge, in units of the quad edge. |p|² − |q|² is the determinant; q = 0 is a similarity.
struct TriangleFrame {
  std::array<std::complex<double>, 3> slope;  ///< p = Σ slope_k · U_k, q = Σ conj(slope_k) · U_k
  double area = 0;                            ///< in quads
};

/// Per triangle.
std::vector<TriangleFrame> triangle_shapes(const FeatureLayout& layout, double quad_m);

struct LinearPart {
  std::complex<double> p, q;
  double determinant() const { return std::norm(p) - std::norm(q); }
};

/// First and second derivatives of an energy by (Re p, Im p, Re q, Im q); the second symmetric, row by row.
struct LinearDerivatives {
  double value = 0;
  std::array<double, 4> gradient{};
  std::array<double, 16> hessian{};
};

/// Sums energies of triangles and their derivatives over the unknowns of a reduction. The pattern of the second
/// derivatives is found once, and so is the order of elimination.
class MapEnergy {
 public:
  static Result<MapEnergy> build(const FeatureLayout& layout, const MapReduction& reduction, double quad_m);

  const std::vector<TriangleFrame>& shapes() const { return shapes_; }
  std::uint32_t unknowns() const { return reduction_->unknowns; }

  /// Linear parts for X, in the common charts, per triangle.
  std::vector<LinearPart> linear_parts(const std::vector<double>& x) const { return parts_of(reduction_->scalars(x)); }

  /// The same of scalars, whether or not they meet the reduction's constraints.
  std::vector<LinearPart> parts_of(const std::vector<double>& scalars) const;

  /// Gradient over X from those of the triangles, weighted with their areas.
  std::vector<double> gradient(const std::vector<LinearDerivatives>& triangles) const;

  /// Factorises Σ area · hessian + shift on the diagonal.
  Result<void> factorize(const std::vector<LinearDerivatives>& triangles, double shift);
  std::vector<double> solve(const std::vector<double>& b) const { return system_->solve(b); }

 private:
  MapEnergy() = default;
  const FeatureLayout* layout_ = nullptr;
  const MapReduction* reduction_ = nullptr;
  std::vector<TriangleFrame> shapes_;
  std::vector<std::uint32_t> scatter_first_;  ///< per triangle and pair of its scalars (21, lower), plus one
  std::vector<std::uint32_t> scatter_slot_;
  std::vector<double> scatter_coefficient_;
  std::vector<std::uint32_t> diagonal_;  ///< per unknown: its place in the values
  std::size_t value_count_ = 0;
  std::unique_ptr<PatternSystem<double>> system_;
};

}  // namespace strataflow
