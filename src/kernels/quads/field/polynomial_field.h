#pragma once
#include <array>
#include <complex>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/result.h"
#include "kernels/quads/field/feature_layout.h"

namespace strataflow {

enum class FrameDistance {
  polynomial,  ///< of Σ ⟨u, s⟩⁴ on the circle: formulas (3.13) to (3.15)
  polyvector   ///< of the coefficients of (z² − u1²)(z² − u2²): formula (3.25), for comparison (S31)
};

/// What two directions, as doubled angles v = e^{2iα}, look like to a distance: `second` turns with twice, `fourth`
/// with four times an angle. The polynomial's are c21 + i c22 = 4 (v1 + v2) and c41 + i c42 = v1² + v2², which is
/// (3.13) on the unit circle and, unlike (3.14) off it, turns with the frame.
struct FrameCoefficients {
  std::complex<double> second, fourth;
};
FrameCoefficients frame_coefficients(std::complex<double> v1, std::complex<double> v2, FrameDistance distance);

struct PolynomialFieldOptions {
  FrameDistance distance = FrameDistance::polynomial;
  double lambda = 1.5;           ///< orthogonality (3.15); a polyvector field takes 1
  double unit_penalty = 0.1;     ///< ε of (3.23)
  double time = 2;               ///< τ of (3.23)
  std::int64_t iterations = 10;  ///< diffusions at most
  std::int64_t inner = 30;       ///< L-BFGS steps of each
  double settled_ratio = 1e-3;   ///< δ of Algorithm 1, per root of the number of cells
  std::function<bool()> is_cancelled = {};
};

struct PolynomialField {
  std::vector<std::array<double, 2>> frames;  ///< as FrameField::angles
  double energy = 0;                          ///< (3.15)
  std::int64_t iterations = 0;
  std::vector<double> energies;  ///< of f_k before and after each step: never rising inside one
};

/// Algorithm 1 of the thesis (coudert2024 S26–S29): directions that need not be orthogonal, by alternating diffusion
/// with analytic gradients (L-BFGS) and normalisation, from crosses `alpha` of the true geometry. Feature edges fix the
/// directions that stand on them exactly, up to two per triangle.
PolynomialField compute_polynomial_field(const FeatureLayout& layout, const std::vector<double>& alpha,
                                         const PolynomialFieldOptions& options = {});

}  // namespace strataflow
