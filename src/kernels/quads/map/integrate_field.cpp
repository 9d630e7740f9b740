#include "kernels/quads/map/integrate_field.h"

#include <algorithm>
#include <cmath>

#include "graph/parallel/parallel_map.h"

namespace strataflow {

Result<std::vector<double>> fit_without_folds(const std::vector<LinearDerivatives>& plain, MapEnergy& energy,
                                              std::int64_t stiffenings, double growth) {
  std::vector<LinearDerivatives> derivatives = plain;
  std::vector<double> weight(plain.size(), 1.0), best;
  std::size_t least = plain.size() + 1;
  std::int64_t best_round = 0;
  for (std::int64_t round = 0; round <= stiffenings; ++round) {
    if (auto factorized = energy.factorize(derivatives, 1e-12); !factorized) {
      if (round == 0) return factorized.failure();
      break;  // weights too far apart
    }
    std::vector<double> right = energy.gradient(derivatives);
    for (double& value : right) value = -value;
    std::vector<double> x = energy.solve(right);
    const std::vector<LinearPart> parts = energy.linear_parts(x);
    std::size_t flipped = 0;
    for (std::size_t t = 0; t < parts.size(); ++t) {
      const double d = parts[t].determinant();
      flipped += !(d > 0);
      if (d > 0.3) continue;
      weight[t] *= d > 0.1 ? 1 + (growth - 1) / 4 : d > 0 ? growth : 2 * growth;
      for (std::size_t i = 0; i < 4; ++i) derivatives[t].gradient[i] = weight[t] * plain[t].gradient[i];
      for (std::size_t i = 0; i < 16; ++i) derivatives[t].hessian[i] = weight[t] * plain[t].hessian[i];
    }
    if (flipped < least) {
      least = flipped;
      best_round = round;
      best = std::move(x);
    }
    if (flipped == 0 || round - best_round > 4) break;
  }
  return best;
}

Result<std::vector<double>> integrate_field(const MapReduction& reduction, const FrameField& field, MapEnergy& energy,
                                            std::int64_t stiffenings, double growth) {
  using Complex = std::complex<double>;
  const std::vector<double> zero(reduction.unknowns, 0.0);
  const std::vector<LinearPart> at_zero = energy.linear_parts(zero);
  const auto plain = parallel_map(
      at_zero.size(),
      [&](std::size_t t) {
        const auto [a, b] = field.angles[t];
        // ∇u = s (cos a, sin a), ∇v = s (cos b, sin b) with s = 1 / sine: isolines at unit distance along each other.
        const double scale = 1 / std::max(0.2, std::sin(b - a));
        const Complex dx = scale * Complex(std::cos(a), std::cos(b)), dy = scale * Complex(std::sin(a), std::sin(b));
        const Complex off_p = at_zero[t].p - turned(0.5 * (dx - Complex(0, 1) * dy), reduction.chart[t]);
        const Complex off_q = at_zero[t].q - turned(0.5 * (dx + Complex(0, 1) * dy), reduction.chart[t]);
        LinearDerivatives d;
        d.gradient = {off_p.real(), off_p.imag(), off_q.real(), off_q.imag()};
        for (std::size_t i = 0; i < 4; ++i) d.hessian[5 * i] = 1;
        return d;
      },
      512);
  return fit_without_folds(plain, energy, stiffenings, growth);
}

}  // namespace strataflow
