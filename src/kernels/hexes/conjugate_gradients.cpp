#include "kernels/hexes/conjugate_gradients.h"

#include <functional>
#include <utility>

#include "graph/parallel/ordered_reduce.h"
#include "graph/parallel/parallel_map.h"

namespace strataflow {
namespace {

double inner(const std::vector<double>& a, const std::vector<double>& b) {
  return ordered_reduce(
      a.size(), 0.0, [&](std::size_t i) { return a[i] * b[i]; }, std::plus<double>());
}

}  // namespace

std::size_t conjugate_gradients(const Multigrid& guide, const std::vector<double>& b, std::vector<double>& x,
                                double tolerance_ratio, std::size_t most_steps) {
  constexpr std::size_t grain = 4096;
  const std::size_t size = b.size();
  const auto ranges = [&](auto&& item) {
    parallel_ranges(size, grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) item(i);
    });
  };
  std::vector<double> residual(size), direction(size, 0), image;
  multiply(guide.matrix(), x, image);
  ranges([&](std::size_t i) { residual[i] = b[i] - image[i]; });
  const double enough = tolerance_ratio * tolerance_ratio * inner(b, b);
  double energy = 1;
  std::size_t step = 0;
  std::vector<Multigrid::Work> work;
  while (step < most_steps && inner(residual, residual) > enough) {
    const std::vector<double>& guided = guide(residual, work);
    const double next = inner(residual, guided), turn = step == 0 ? 0 : next / energy;
    energy = next;
    ranges([&](std::size_t i) { direction[i] = guided[i] + turn * direction[i]; });
    multiply(guide.matrix(), direction, image);
    const double curvature = inner(direction, image);
    if (!(curvature > 0)) break;
    ++step;
    const double length = energy / curvature;
    ranges([&](std::size_t i) {
      x[i] += length * direction[i];
      residual[i] -= length * image[i];
    });
  }
  return step;
}

Result<std::vector<std::vector<double>>> solve_symmetric(std::uint32_t size, const std::vector<MatrixEntry>& lower,
                                                         const std::vector<std::vector<double>>& right,
                                                         std::vector<std::vector<double>> starts) {
  constexpr std::uint32_t most_factorised = 2000;
  constexpr std::size_t most_steps = 2000;
  std::vector<std::vector<double>> solutions;
  if (size <= most_factorised) {
    const Result<SymmetricSystem> system = SymmetricSystem::factorize(size, lower);
    if (!system) return system.failure();
    for (const std::vector<double>& b : right) solutions.push_back(system->solve(b));
    return solutions;
  }
  const Multigrid guide(symmetric_rows(size, lower), constant_mode(size));
  solutions = std::move(starts);
  solutions.resize(right.size(), std::vector<double>(size, 0));
  for (std::size_t i = 0; i < right.size(); ++i)
    if (conjugate_gradients(guide, right[i], solutions[i], 1e-11, most_steps) == most_steps)
      return Failure{FailureCode::geometry_failed, "the linear system has no unique solution",
                     "fix or constrain at least one point of every connected piece"};
  return solutions;
}

}  // namespace strataflow
