#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/adapters/sparse/symmetric_system.h"

namespace strataflow {

/// A sparse matrix row by row. Square ones here are symmetric, with both triangles.
struct SparseRows {
  std::vector<std::uint32_t> first;  ///< per row, plus one
  std::vector<std::uint32_t> columns;
  std::vector<double> values;
  std::uint32_t size() const { return static_cast<std::uint32_t>(first.size()) - 1; }
};

/// Sums up entries of a lower triangle; several may lie at one place. Columns ascend in each row.
SparseRows symmetric_rows(std::uint32_t size, const std::vector<MatrixEntry>& lower);

/// result = matrix · v.
void multiply(const SparseRows& matrix, const std::vector<double>& v, std::vector<double>& result);

/// What a matrix hardly resists: up to two vectors, and which unknowns belong together.
struct SoftModes {
  std::vector<std::uint32_t> first;  ///< per node, plus one: its unknowns, which lie side by side
  std::vector<std::array<double, 2>> of_unknown;
  std::uint32_t count = 1;  ///< of vectors
};

/// Every unknown a node of its own; all of them alike is what is not resisted.
SoftModes constant_mode(std::uint32_t size);

/// A cheap stand-in for the inverse of a symmetric positive definite matrix like those of springs or diffusion: one
/// cycle of smoothed aggregation (Vaněk, Mandel, Brezina 1996). Building and using it take time in proportion to the
/// entries. It is linear, symmetric and positive definite, so it guides conjugate gradients; the same bits on every
/// schedule.
class Multigrid {
 public:
  Multigrid(SparseRows matrix, SoftModes modes);

  const SparseRows& matrix() const { return levels_.front().matrix; }
  std::vector<double> operator()(const std::vector<double>& b) const;

  /// What a cycle needs at each level, made once for many.
  struct Work {
    std::vector<double> residual, x, first, second;
  };
  /// The same; the result stays valid until the next call with this `work`.
  const std::vector<double>& operator()(const std::vector<double>& b, std::vector<Work>& work) const;

 private:
  struct Level {
    SparseRows matrix;
    std::vector<double> inverse;  // per row, of the sum of its entries' sizes: eigenvalues up to one
    SparseRows up, down;          // from the next level here, and back
  };
  void cycle(std::size_t level, std::vector<Work>& work) const;

  std::vector<Level> levels_;
  std::optional<SymmetricSystem> coarsest_;
};

}  // namespace strataflow
