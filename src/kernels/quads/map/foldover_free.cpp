#include "kernels/quads/map/foldover_free.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "graph/parallel/ordered_reduce.h"

namespace strataflow {

namespace {

/// χ without cancellation for negative determinants.
double positive_part(double d, double root, double epsilon) {
  return d >= 0 ? (d + root) / 2 : epsilon * epsilon / (2 * (root - d));
}

double energy_value(const LinearPart& part, double theta, double epsilon) {
  const double d = part.determinant();
  const double chi = positive_part(d, std::hypot(d, epsilon), epsilon);
  return (2 * (std::norm(part.p) + std::norm(part.q)) + theta * (d * d + 1)) / chi;
}

}  // namespace

LinearDerivatives foldover_energy(const LinearPart& part, double theta, double epsilon) {
  const double pp = std::norm(part.p), qq = std::norm(part.q);
  const double d = pp - qq, root = std::hypot(d, epsilon);
  const double chi = positive_part(d, root, epsilon);
  const double slope = chi / root, bend = epsilon * epsilon / (2 * root * root * root);
  const double top = 2 * (pp + qq) + theta * (d * d + 1);
  LinearDerivatives out;
  out.value = top / chi;
  // By N = |J|² and by the determinant.
  const double f_n = 1 / chi, f_nd = -slope / (chi * chi);
  const double f_d = 2 * theta * d / chi - top * slope / (chi * chi);
  const double f_dd = 2 * theta / chi - 4 * theta * d * slope / (chi * chi) - top * bend / (chi * chi) +
                      2 * top * slope * slope / (chi * chi * chi);
  // By |p| and |q| (along) and around them (across): the second derivatives fall apart into two numbers and a 2×2
  // block.
  const double across_p = 4 * f_n + 2 * f_d, across_q = 4 * f_n - 2 * f_d;
  const double along_p = across_p + pp * (16 * f_nd + 4 * f_dd), along_q = across_q + qq * (4 * f_dd - 16 * f_nd);
  const double mixed = -4 * std::sqrt(pp * qq) * f_dd;
  out.gradient = {across_p * part.p.real(), across_p * part.p.imag(), across_q * part.q.real(),
                  across_q * part.q.imag()};
  // The block made positive by its eigenvalues.
  const double mean = (along_p + along_q) / 2, half = (along_p - along_q) / 2, radius = std::hypot(half, mixed);
  const double high = std::max(0.0, mean + radius), low = std::max(0.0, mean - radius);
  double block_pp = std::max(0.0, along_p), block_qq = std::max(0.0, along_q), block_pq = 0;
  if (radius > 0) {
    const double c = half / radius, s = mixed / radius;  // cosine and sine of twice the angle of the first axis
    block_pp = (high + low) / 2 + c * (high - low) / 2;
    block_qq = (high + low) / 2 - c * (high - low) / 2;
    block_pq = s * (high - low) / 2;
  }
  const double round_p = std::max(0.0, across_p), round_q = std::max(0.0, across_q);
  const std::complex<double> p = pp > 0 ? part.p / std::sqrt(pp) : 1.0, q = qq > 0 ? part.q / std::sqrt(qq) : 1.0;
  const std::array<double, 4> u{p.real(), p.imag(), q.real(), q.imag()};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      double& h = out.hessian[4 * i + j];
      if (i / 2 != j / 2) {
        h = block_pq * u[i] * u[j];
      } else {
        const double along = i < 2 ? block_pp : block_qq, across = i < 2 ? round_p : round_q;
        h = (along - across) * u[i] * u[j] + (i == j ? across : 0.0);
      }
    }
  return out;
}

namespace {

/// One descent from x with ε starting at `epsilon`.
Result<FoldoverFreeReport> descend(MapEnergy& energy, std::vector<double>& x, double epsilon,
                                   const FoldoverFreeOptions& options) {
  const auto& shapes = energy.shapes();
  const std::size_t count = shapes.size();
  const double theta = options.area_weight;
  double whole = 0;
  for (const TriangleFrame& shape : shapes) whole += shape.area;
  FoldoverFreeReport report;
  std::vector<double> epsilons(count);
  double shift = 1e-10;
  int full_steps = 0;  // in a row, on a valid map
  const auto value_at = [&](const std::vector<LinearPart>& parts) {
    return ordered_reduce(
        count, 0.0, [&](std::size_t t) { return shapes[t].area * energy_value(parts[t], theta, epsilons[t]); },
        [](double a, double b) { return a + b; });
  };
  const auto look = [&](const std::vector<LinearPart>& parts) {
    report.smallest_determinant = std::numeric_limits<double>::infinity();
    report.flipped = 0;
    for (std::uint32_t t = 0; t < count; ++t) {
      const double d = parts[t].determinant();
      report.flipped += !(d > 0);
      if (d < report.smallest_determinant) {
        report.smallest_determinant = d;
        report.worst_triangle = t;
      }
    }
  };
  std::vector<LinearPart> parts = energy.linear_parts(x);
  look(parts);
  report.flipped_before = report.flipped;
  report.stopped_by = "iterations used up";
  while (report.iterations < options.iterations) {
    if (options.is_cancelled && options.is_cancelled()) {
      report.stopped_by = "cancelled";
      break;
    }
    if (report.flipped == 0) epsilon = 1e-12;
    for (std::size_t t = 0; t < count; ++t)
      epsilons[t] = std::hypot(epsilon, 0.2 * std::min(0.0, parts[t].determinant()));
    const auto derivatives = parallel_map(
        count, [&](std::size_t t) { return foldover_energy(parts[t], theta, epsilons[t]); }, 512);
    const double before = value_at(parts);
    std::vector<double> gradient = energy.gradient(derivatives);
    // Rounding can make the matrix of a badly folded map indefinite: then with a heavier diagonal.
    // Near the minimum an earlier factor serves as well.
    const bool reuses = report.flipped == 0 && full_steps % 3 != 0;
    Result<void> factorized = reuses ? Result<void>{} : energy.factorize(derivatives, shift);
    for (int heavier = 0; !factorized && heavier < 8; ++heavier)
      factorized = energy.factorize(derivatives, shift *= 100);
    if (!factorized) return factorized.failure();
    std::vector<double> step = energy.solve(gradient);
    double slope = 0;
    for (std::size_t i = 0; i < step.size(); ++i) slope -= gradient[i] * step[i];
    ++report.iterations;
    // Backtracking until the energy falls enough.
    double length = 1, after = before;
    std::vector<double> next(x.size());
    std::vector<LinearPart> next_parts;
    bool found = false;
    for (int halving = 0; halving < 40 && !found; ++halving, length /= 2) {
      for (std::size_t i = 0; i < x.size(); ++i) next[i] = x[i] - length * step[i];
      next_parts = energy.linear_parts(next);
      if (report.flipped == 0 && std::any_of(next_parts.begin(), next_parts.end(),
                                             [](const LinearPart& part) { return !(part.determinant() > 0); }))
        continue;
      after = value_at(next_parts);
      found = after <= before + 1e-4 * length * slope;
    }
    const bool was_valid = report.flipped == 0;
    full_steps = was_valid && found && length == 0.5 ? full_steps + 1 : 0;  // halved once more after the step
    if (found) {
      x.swap(next);
      parts.swap(next_parts);
      look(parts);
      report.energy = after / whole;
    }
    if (was_valid && (!found || before - after <= options.tolerance * before)) {
      report.stopped_by = "settled";
      break;
    }
    if (report.flipped == 0) continue;
    // Lower ε once nothing is folded deeper than it, or nothing moves any more.
    if (-report.smallest_determinant < epsilon)
      epsilon /= 2;
    else if (!found || before - after < 0.003 * before)
      epsilon *= 0.8;
    if (!(epsilon > 1e-6)) {
      report.stopped_by = "no step lowers the energy";
      break;
    }
  }
  return report;
}

}  // namespace

Result<FoldoverFreeReport> make_foldover_free(MapEnergy& energy, std::vector<double>& x,
                                              const FoldoverFreeOptions& options) {
  const std::vector<double> start = x;
  std::int64_t spent = 0, flipped_before = 0;
  // What one ε folds away into a corner another unfolds.
  for (const double epsilon : {0.1, 0.02, 1.0, 0.3}) {
    std::vector<double> at = start;
    Result<FoldoverFreeReport> report = descend(energy, at, epsilon, options);
    if (!report) return report;
    if (spent == 0) flipped_before = report->flipped_before;
    spent += report->iterations;
    report->iterations = spent;
    report->flipped_before = flipped_before;
    x = std::move(at);
    if (report->flipped == 0 || epsilon == 0.3 || report->stopped_by == "cancelled") return report;
  }
  return Failure{FailureCode::internal_error, "no descent was tried", "report this"};
}

}  // namespace strataflow
