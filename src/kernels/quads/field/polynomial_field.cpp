#include "kernels/quads/field/polynomial_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/id.h"
#include "graph/parallel/ordered_reduce.h"
#include "kernels/adapters/lbfgs/minimize.h"
#include "kernels/quads/field/straighten_angles.h"

namespace strataflow {

namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;
constexpr std::size_t grain = 1024;

/// f_k of (3.23) over the entries that are not fixed. Unknowns: real and imaginary part of each entry, 4 per cell;
/// gradients of fixed ones are zero.
struct Diffusion {
  const FeatureLayout& layout;
  const PolynomialFieldOptions& options;
  double lambda_squared;
  std::vector<Complex> turn;  ///< per half-edge: e^{2i·angle} that takes the opposite cell's directions into ours
  std::vector<std::uint8_t> fixed;  ///< per entry
  std::vector<double> before;       ///< v^(k)

  static Complex entry(const std::vector<double>& v, std::size_t i) { return {v[2 * i], v[2 * i + 1]}; }
  FrameCoefficients coefficients(const std::vector<double>& v, std::size_t cell) const {
    return frame_coefficients(entry(v, 2 * cell), entry(v, 2 * cell + 1), options.distance);
  }
  /// Difference of the coefficients of a cell and its neighbour across h, in the cell's own plane.
  FrameCoefficients difference(const std::vector<FrameCoefficients>& c, std::uint32_t h) const {
    const FrameCoefficients &ours = c[h / 3], &theirs = c[layout.opposite[h] / 3];
    return {ours.second - turn[h] * theirs.second, ours.fourth - turn[h] * turn[h] * theirs.fourth};
  }
  std::vector<FrameCoefficients> all_coefficients(const std::vector<double>& v) const {
    return parallel_map(
        layout.triangle_count(), [&](std::size_t t) { return coefficients(v, t); }, grain);
  }
  double smoothness(const std::vector<FrameCoefficients>& c) const {
    return ordered_reduce(
        3 * c.size(), 0.0,
        [&](std::size_t h) {
          const std::uint32_t g = layout.opposite[h];
          if (g == no_index || g < h) return 0.0;
          const FrameCoefficients d = difference(c, static_cast<std::uint32_t>(h));
          return lambda_squared * std::norm(d.second) + std::norm(d.fourth);
        },
        [](double a, double b) { return a + b; });
  }
  bool is_regularised(std::size_t cell) const { return fixed[2 * cell] || fixed[2 * cell + 1]; }

  double operator()(const std::vector<double>& v, std::vector<double>& gradient) const {
    const auto c = all_coefficients(v);
    const double local = ordered_reduce(
        fixed.size(), 0.0,
        [&](std::size_t i) {
          if (fixed[i]) return 0.0;
          const double off = std::norm(entry(v, i)) - 1;
          return (is_regularised(i / 2) ? off * off / options.unit_penalty : 0.0) +
                 std::norm(entry(v, i) - entry(before, i)) / options.time;
        },
        [](double a, double b) { return a + b; });
    parallel_ranges(layout.triangle_count(), grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) {
        Complex second = 0, fourth = 0;  // of the energy by the conjugates of our coefficients, twice
        for (auto h = static_cast<std::uint32_t>(3 * t); h < 3 * t + 3; ++h) {
          if (layout.opposite[h] == no_index) continue;
          const FrameCoefficients d = difference(c, h);
          second += 2 * lambda_squared * d.second;
          fourth += 2.0 * d.fourth;
        }
        for (std::size_t i = 2 * t; i < 2 * t + 2; ++i) {
          Complex g = 0;
          if (!fixed[i]) {
            const Complex own = entry(v, i), other = entry(v, i ^ 1);
            g = options.distance == FrameDistance::polynomial ? 4.0 * second + 2.0 * std::conj(own) * fourth
                                                              : second + std::conj(other) * fourth;
            if (is_regularised(t)) g += 4 * (std::norm(own) - 1) / options.unit_penalty * own;
            g += 2 / options.time * (own - entry(before, i));
          }
          gradient[2 * i] = g.real();
          gradient[2 * i + 1] = g.imag();
        }
      }
    });
    return smoothness(c) + local;
  }
};

}  // namespace

FrameCoefficients frame_coefficients(Complex v1, Complex v2, FrameDistance distance) {
  if (distance == FrameDistance::polyvector) return {v1 + v2, v1 * v2};
  return {4.0 * (v1 + v2), v1 * v1 + v2 * v2};
}

PolynomialField compute_polynomial_field(const FeatureLayout& layout, const std::vector<double>& alpha,
                                         const PolynomialFieldOptions& options) {
  const auto count = static_cast<std::uint32_t>(layout.triangle_count());
  const bool polyvector = options.distance == FrameDistance::polyvector;
  Diffusion diffusion{layout,
                      options,
                      polyvector ? 1.0 : options.lambda * options.lambda,
                      std::vector<Complex>(3 * count),
                      std::vector<std::uint8_t>(2 * count, 0),
                      {}};
  std::vector<double> v(4 * count);
  const auto set = [&](std::size_t i, double angle) {
    v[2 * i] = std::cos(2 * angle);
    v[2 * i + 1] = std::sin(2 * angle);
  };
  std::vector<std::array<double, 2>> exact(count, {0, 0});
  for (std::uint32_t t = 0; t < count; ++t) {
    set(2 * t, alpha[t]);
    set(2 * t + 1, alpha[t] + pi / 2);
    std::uint32_t next = 0;
    for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
      if (layout.opposite[h] != no_index)
        diffusion.turn[h] = std::polar(
            1.0, 2 * (half_edge_direction(layout.angle, h) - half_edge_direction(layout.angle, layout.opposite[h])));
      if (!layout.is_feature[h] || next == 2) continue;
      exact[t][next] = half_edge_direction(layout.angle, h) + pi / 2;  // a gradient stands on the edge (S28)
      set(2 * t + next, exact[t][next]);
      if (next == 0) set(2 * t + 1, exact[t][0] + pi / 2);
      diffusion.fixed[2 * t + next++] = 1;
    }
  }
  PolynomialField field;
  const Objective objective = [&](const std::vector<double>& x, std::vector<double>& gradient) {
    return diffusion(x, gradient);
  };
  std::vector<double> gradient(v.size());
  while (field.iterations < options.iterations) {
    if (options.is_cancelled && options.is_cancelled()) break;
    diffusion.before = v;
    std::vector<double> w = v;
    field.energies.push_back(objective(w, gradient));
    minimize(w, objective,
             {.iterations = static_cast<std::size_t>(options.inner), .is_cancelled = options.is_cancelled});
    field.energies.push_back(objective(w, gradient));
    double change = 0;
    for (std::size_t i = 0; i < 2 * count; ++i) {
      if (diffusion.fixed[i]) continue;
      const double size = std::abs(Diffusion::entry(w, i));
      if (!(size > 1e-12)) continue;
      for (std::size_t k = 2 * i; k < 2 * i + 2; ++k) {
        change += (w[k] / size - v[k]) * (w[k] / size - v[k]);
        v[k] = w[k] / size;
      }
    }
    ++field.iterations;
    if (std::sqrt(change) <= options.settled_ratio * std::sqrt(static_cast<double>(count))) break;
  }
  field.energy = diffusion.smoothness(diffusion.all_coefficients(v));
  field.frames.resize(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    for (std::uint32_t i = 0; i < 2; ++i)
      field.frames[t][i] =
          diffusion.fixed[2 * t + i] ? exact[t][i] : std::atan2(v[4 * t + 2 * i + 1], v[4 * t + 2 * i]) / 2;
    auto& [a, b] = field.frames[t];
    b = a + std::fmod(std::fmod(b - a, pi) + pi, pi);
  }
  return field;
}

}  // namespace strataflow
