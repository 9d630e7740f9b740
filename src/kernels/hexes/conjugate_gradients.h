#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernels/adapters/sparse/symmetric_system.h"

namespace strataflow {

/// A symmetric positive definite matrix, both triangles, row by row.
struct SymmetricRows {
  std::vector<std::uint32_t> first;    ///< per row, plus one
  std::vector<std::uint32_t> columns;  ///< ascending in each row
  std::vector<double> values;
  std::uint32_t size() const { return static_cast<std::uint32_t>(first.size()) - 1; }
};

/// Sums up entries of a lower triangle; several may lie at one place.
SymmetricRows symmetric_rows(std::uint32_t size, const std::vector<MatrixEntry>& lower);

/// Solves A x = b by conjugate gradients, scaled by the diagonal, from x; until the residual is below
/// `tolerance_ratio` of b's or `most_steps` are done. Returns the steps. The same bits on every schedule.
std::size_t conjugate_gradients(const SymmetricRows& matrix, const std::vector<double>& b, std::vector<double>& x,
                                double tolerance_ratio, std::size_t most_steps);

/// x with A x = b for each b: factorised once where that is cheap (up to 40 000 unknowns), by conjugate gradients
/// beyond. Fails where factorising fails.
Result<std::vector<std::vector<double>>> solve_symmetric(std::uint32_t size, const std::vector<MatrixEntry>& lower,
                                                         const std::vector<std::vector<double>>& right);

}  // namespace strataflow
