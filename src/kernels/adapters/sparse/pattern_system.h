#pragma once
#include <complex>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/result.h"

namespace strataflow {

/// Positive definite matrices of one pattern: the order of elimination is found once, values may change. `Number` is
/// double (symmetric) or std::complex<double> (Hermitian). CHOLMOD's simplicial LDLᵀ, which calls no BLAS: the same
/// bits whatever BLAS is installed.
template <class Number>
class PatternSystem {
 public:
  /// The lower triangle by columns: rows ascending in [starts[c], starts[c + 1]), the diagonal first and always there.
  /// Fails with invalid_input when it is not so.
  static Result<PatternSystem> analyse(std::vector<std::uint32_t> starts, std::vector<std::uint32_t> rows);

  /// `values` as `rows`. Fails with geometry_failed when the matrix is not positive definite, invalid_input when a
  /// value is not finite.
  Result<void> factorize(const std::vector<Number>& values);

  /// x with A x = b, of the matrix factorised last.
  std::vector<Number> solve(const std::vector<Number>& b) const;

  PatternSystem(PatternSystem&&) noexcept;
  PatternSystem& operator=(PatternSystem&&) noexcept;
  ~PatternSystem();

 private:
  struct Factor;
  explicit PatternSystem(std::unique_ptr<Factor> factor);
  std::unique_ptr<Factor> factor_;
};

extern template class PatternSystem<double>;
extern template class PatternSystem<std::complex<double>>;

/// Collects a lower triangle entry by entry, then hands out its pattern and where each entry went.
class PatternBuilder {
 public:
  explicit PatternBuilder(std::uint32_t size) : size_(size) {}
  /// Entry (row, column) or (column, row), whichever lies below. Returns its number, to be looked up in `slots`.
  std::size_t add(std::uint32_t row, std::uint32_t column);
  /// Ends the collection: `starts` and `rows` as PatternSystem::analyse wants them (diagonals are added), and per
  /// entry added its place in `rows`.
  void finish(std::vector<std::uint32_t>& starts, std::vector<std::uint32_t>& rows, std::vector<std::uint32_t>& slots);

 private:
  std::uint32_t size_ = 0;
  std::vector<std::uint32_t> rows_, columns_;
};

}  // namespace strataflow
