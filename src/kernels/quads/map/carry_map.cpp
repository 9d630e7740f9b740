#include "kernels/quads/map/carry_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/id.h"
#include "graph/parallel/ordered_reduce.h"
#include "graph/parallel/parallel_map.h"

namespace strataflow {

namespace {

using Complex = std::complex<double>;
constexpr std::size_t grain = 512;

/// The first step > 0 at which the determinant of `at` + step · `by` is 0; infinity if there is none.
double first_fold(const LinearPart& at, const LinearPart& by) {
  const double a = by.determinant();
  const double b = std::real(std::conj(at.p) * by.p) - std::real(std::conj(at.q) * by.q);  // half of it
  const double c = at.determinant();
  const double root = b * b - a * c;
  if (!(root >= 0)) return std::numeric_limits<double>::infinity();
  // c / (−b ± √root), the smaller positive one.
  const double low = -b + std::sqrt(root);
  return low > 0 ? c / low : std::numeric_limits<double>::infinity();
}

}  // namespace

Result<std::vector<double>> develop_map(const FeatureLayout& layout, const MapReduction& reduction,
                                        const CornerMap& map) {
  const auto count = static_cast<std::uint32_t>(layout.triangle_count());
  std::vector<double> scalars(reduction.constant.size(), 0.0);
  std::vector<Complex> shift(count, 0.0);
  std::vector<std::uint8_t> is_reached(count, 0);
  const auto value = [&](std::uint32_t h) { return turned(map.at(h), reduction.chart[h / 3]) + shift[h / 3]; };
  std::vector<std::uint32_t> queue;
  for (std::uint32_t seed = 0; seed < count; ++seed) {
    if (is_reached[seed]) continue;
    is_reached[seed] = 1;
    queue.assign(1, seed);
    for (std::size_t next = 0; next < queue.size(); ++next)
      for (std::uint32_t h = 3 * queue[next]; h < 3 * queue[next] + 3; ++h) {
        const std::uint32_t place = reduction.place_of[h], g = layout.opposite[h];
        scalars[2 * place] = value(h).real();
        scalars[2 * place + 1] = value(h).imag();
        if (g == no_index || is_reached[g / 3] || reduction.place_of[next_half_edge(g)] != place ||
            reduction.place_of[g] != reduction.place_of[next_half_edge(h)])
          continue;
        is_reached[g / 3] = 1;
        shift[g / 3] = value(h) - value(next_half_edge(g));
        queue.push_back(g / 3);
      }
  }
  double size = 0, off = 0;
  for (const double s : scalars) size = std::max(size, std::abs(s));
  for (std::uint32_t h = 0; h < 3 * count; ++h) {
    const std::uint32_t place = reduction.place_of[h];
    off = std::max(off, std::abs(value(h) - Complex(scalars[2 * place], scalars[2 * place + 1])));
  }
  if (!(off <= 1e-7 * size))
    return Failure{FailureCode::invalid_input, "the map tears where the reduction joins",
                   "carry only maps with the same turns"};
  return scalars;
}

Result<std::vector<double>> carry_map(MapEnergy& energy, const MapReduction& reduction, std::vector<double> scalars,
                                      std::int64_t steps, const FoldoverFreeOptions& options) {
  constexpr double epsilon = 1e-12, nearest_to_fold = 0.8, most_growth = 3;
  const std::size_t count = energy.shapes().size();
  const auto value_of = [&](const std::vector<LinearPart>& parts) {
    return ordered_reduce(
        count, 0.0,
        [&](std::size_t t) {
          return energy.shapes()[t].area * foldover_energy(parts[t], options.area_weight, epsilon).value;
        },
        [](double a, double b) { return a + b; });
  };
  const auto folded = [](const std::vector<LinearPart>& parts) {
    return std::any_of(parts.begin(), parts.end(), [](const LinearPart& p) { return !(p.determinant() > 0); });
  };
  std::vector<LinearPart> parts = energy.parts_of(scalars);
  if (folded(parts))
    return Failure{FailureCode::invalid_input, "the map is folded before it is carried", "start from a valid map"};
  std::vector<double> x(reduction.unknowns, 0.0), way(scalars.size());
  double value = value_of(parts);
  for (std::int64_t step = 0; step < steps; ++step) {
    if (options.is_cancelled && options.is_cancelled()) break;
    const std::vector<double> target = reduction.scalars(x);
    for (std::size_t s = 0; s < way.size(); ++s) way[s] = target[s] - scalars[s];
    // The quadratic model of the energy at the map, seen from where the target is now.
    const std::vector<LinearPart> off = energy.parts_of(way);
    const auto derivatives = parallel_map(
        count,
        [&](std::size_t t) {
          LinearDerivatives d = foldover_energy(parts[t], options.area_weight, epsilon);
          const std::array<double, 4> by{off[t].p.real(), off[t].p.imag(), off[t].q.real(), off[t].q.imag()};
          for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j) d.gradient[i] += d.hessian[4 * i + j] * by[j];
          return d;
        },
        grain);
    if (auto factorized = energy.factorize(derivatives, 1e-10); !factorized) return factorized.failure();
    const std::vector<double> y = energy.solve(energy.gradient(derivatives));
    for (std::size_t i = 0; i < x.size(); ++i) x[i] -= y[i];
    const std::vector<double> better = reduction.scalars(x);
    for (std::size_t s = 0; s < way.size(); ++s) way[s] = better[s] - scalars[s];
    const std::vector<LinearPart> by = energy.parts_of(way);
    double fold = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < count; ++t) fold = std::min(fold, first_fold(parts[t], by[t]));
    const double all = std::min(1.0, nearest_to_fold * fold);
    double length = all;
    std::vector<double> next(scalars.size());
    std::vector<LinearPart> next_parts;
    for (int halving = 0; halving < 20; ++halving, length /= 2) {
      for (std::size_t s = 0; s < next.size(); ++s) next[s] = length == 1 ? better[s] : scalars[s] + length * way[s];
      next_parts = energy.parts_of(next);
      if (folded(next_parts)) continue;
      const double after = value_of(next_parts);
      if (!(after <= most_growth * value)) continue;
      value = after;
      scalars.swap(next);
      parts.swap(next_parts);
      if (length == 1) return x;
      break;
    }
    if (!(length > 1e-4)) break;
  }
  return Failure{FailureCode::geometry_failed, "the map cannot be carried over to its constraints without a fold",
                 "start afresh"};
}

}  // namespace strataflow
