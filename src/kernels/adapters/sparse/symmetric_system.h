#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "base/result.h"

namespace strataflow {

/// One entry of a sparse matrix. Entries at the same place add up, in the order given.
struct MatrixEntry {
  std::uint32_t row = 0;
  std::uint32_t column = 0;
  double value = 0;
};

/// A factorised symmetric positive definite system, solved as often as wanted. Uses CHOLMOD's simplicial LDLᵀ, which
/// calls no BLAS: the same bits whatever BLAS is installed (the supernodal method's differ between them).
class SymmetricSystem {
 public:
  /// Factorises the `size` × `size` matrix whose lower triangle (row ≥ column) is given. Fails with geometry_failed
  /// when the matrix is not positive definite, invalid_input for an entry out of range or not finite.
  static Result<SymmetricSystem> factorize(std::uint32_t size, const std::vector<MatrixEntry>& lower);

  /// x with A x = b; b has `size` numbers.
  std::vector<double> solve(const std::vector<double>& b) const;

  SymmetricSystem(SymmetricSystem&&) noexcept;
  SymmetricSystem& operator=(SymmetricSystem&&) noexcept;
  ~SymmetricSystem();

 private:
  struct Factor;
  explicit SymmetricSystem(std::unique_ptr<Factor> factor);
  std::unique_ptr<Factor> factor_;
};

}  // namespace strataflow
