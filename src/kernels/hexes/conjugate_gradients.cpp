#include "kernels/hexes/conjugate_gradients.h"

#include <algorithm>
#include <cmath>

#include "graph/parallel/ordered_reduce.h"
#include "graph/parallel/parallel_map.h"

namespace strataflow {
namespace {

constexpr std::size_t grain = 4096;

double inner(const std::vector<double>& a, const std::vector<double>& b) {
  return ordered_reduce(
      a.size(), 0.0, [&](std::size_t i) { return a[i] * b[i]; }, std::plus<double>());
}

}  // namespace

SymmetricRows symmetric_rows(std::uint32_t size, const std::vector<MatrixEntry>& lower) {
  SymmetricRows rows;
  rows.first.assign(size + 1, 0);
  for (const MatrixEntry& entry : lower) {
    ++rows.first[entry.row + 1];
    if (entry.row != entry.column) ++rows.first[entry.column + 1];
  }
  for (std::uint32_t i = 0; i < size; ++i) rows.first[i + 1] += rows.first[i];
  struct Item {
    std::uint32_t column;
    double value;
  };
  std::vector<Item> items(rows.first[size]);
  std::vector<std::uint32_t> next(rows.first.begin(), rows.first.end() - 1);
  for (const MatrixEntry& entry : lower) {
    items[next[entry.row]++] = {entry.column, entry.value};
    if (entry.row != entry.column) items[next[entry.column]++] = {entry.row, entry.value};
  }
  // Entries of one place are summed in the order given.
  std::vector<std::uint32_t> kept(size, 0);
  parallel_ranges(size, 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto from = items.begin() + rows.first[i], to = items.begin() + rows.first[i + 1];
      std::stable_sort(from, to, [](const Item& a, const Item& b) { return a.column < b.column; });
      auto last = from;
      for (auto it = from; it != to; ++it) {
        if (it != from && it->column == last->column)
          last->value += it->value;
        else if (it != from)
          *++last = *it;
      }
      kept[i] = from == to ? 0 : static_cast<std::uint32_t>(last - from) + 1;
    }
  });
  std::vector<std::uint32_t> first{0};
  for (std::uint32_t i = 0; i < size; ++i) first.push_back(first.back() + kept[i]);
  rows.columns.resize(first.back());
  rows.values.resize(first.back());
  for (std::uint32_t i = 0; i < size; ++i)
    for (std::uint32_t k = 0; k < kept[i]; ++k) {
      rows.columns[first[i] + k] = items[rows.first[i] + k].column;
      rows.values[first[i] + k] = items[rows.first[i] + k].value;
    }
  rows.first = std::move(first);
  return rows;
}

std::size_t conjugate_gradients(const SymmetricRows& matrix, const std::vector<double>& b, std::vector<double>& x,
                                double tolerance_ratio, std::size_t most_steps) {
  const std::size_t size = matrix.size();
  const auto apply = [&](const std::vector<double>& v, std::vector<double>& result) {
    parallel_ranges(size, grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        double sum = 0;
        for (std::uint32_t k = matrix.first[i]; k < matrix.first[i + 1]; ++k) sum += matrix.values[k] * v[matrix.columns[k]];
        result[i] = sum;
      }
    });
  };
  std::vector<double> inverse(size, 1), residual(size), scaled(size), direction(size), image(size);
  for (std::uint32_t i = 0; i < size; ++i)
    for (std::uint32_t k = matrix.first[i]; k < matrix.first[i + 1]; ++k)
      if (matrix.columns[k] == i && matrix.values[k] > 0) inverse[i] = 1 / matrix.values[k];
  apply(x, image);
  for (std::size_t i = 0; i < size; ++i) {
    residual[i] = b[i] - image[i];
    direction[i] = scaled[i] = inverse[i] * residual[i];
  }
  const double enough = tolerance_ratio * tolerance_ratio * inner(b, b);
  double energy = inner(residual, scaled);
  std::size_t step = 0;
  while (step < most_steps && inner(residual, residual) > enough) {
    ++step;
    apply(direction, image);
    const double curvature = inner(direction, image);
    if (!(curvature > 0)) break;
    const double length = energy / curvature;
    parallel_ranges(size, grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        x[i] += length * direction[i];
        residual[i] -= length * image[i];
        scaled[i] = inverse[i] * residual[i];
      }
    });
    const double next = inner(residual, scaled);
    const double turn = next / energy;
    energy = next;
    parallel_ranges(size, grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) direction[i] = scaled[i] + turn * direction[i];
    });
  }
  return step;
}

Result<std::vector<std::vector<double>>> solve_symmetric(std::uint32_t size, const std::vector<MatrixEntry>& lower,
                                                         const std::vector<std::vector<double>>& right) {
  constexpr std::uint32_t most_factorised = 40000;
  std::vector<std::vector<double>> solutions;
  if (size <= most_factorised) {
    const Result<SymmetricSystem> system = SymmetricSystem::factorize(size, lower);
    if (!system) return system.failure();
    for (const std::vector<double>& b : right) solutions.push_back(system->solve(b));
    return solutions;
  }
  const SymmetricRows rows = symmetric_rows(size, lower);
  for (const std::vector<double>& b : right) {
    solutions.emplace_back(size, 0.0);
    conjugate_gradients(rows, b, solutions.back(), 1e-11, 20000);
  }
  return solutions;
}

}  // namespace strataflow
