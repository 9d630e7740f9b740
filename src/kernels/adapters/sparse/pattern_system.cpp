#include "kernels/adapters/sparse/pattern_system.h"

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cmath>
#include <string>

namespace strataflow {

template <class Number>
struct PatternSystem<Number>::Factor {
  Eigen::SparseMatrix<Number> matrix;
  Eigen::CholmodSimplicialLDLT<Eigen::SparseMatrix<Number>, Eigen::Lower> factor;
};

template <class Number>
PatternSystem<Number>::PatternSystem(std::unique_ptr<Factor> factor) : factor_(std::move(factor)) {}
template <class Number>
PatternSystem<Number>::PatternSystem(PatternSystem&&) noexcept = default;
template <class Number>
PatternSystem<Number>& PatternSystem<Number>::operator=(PatternSystem&&) noexcept = default;
template <class Number>
PatternSystem<Number>::~PatternSystem() = default;

template <class Number>
Result<PatternSystem<Number>> PatternSystem<Number>::analyse(std::vector<std::uint32_t> starts,
                                                             std::vector<std::uint32_t> rows) {
  const std::size_t size = starts.empty() ? 0 : starts.size() - 1;
  bool good = size > 0 && starts[0] == 0 && starts.back() == rows.size() && rows.size() < 0x7fffffffu;
  for (std::size_t c = 0; good && c < size; ++c) {
    good = starts[c] < starts[c + 1] && starts[c + 1] <= rows.size() && rows[starts[c]] == c;
    for (std::size_t i = starts[c] + 1; good && i < starts[c + 1]; ++i) good = rows[i] > rows[i - 1] && rows[i] < size;
  }
  if (!good)
    return Failure{FailureCode::invalid_input, "the pattern of a sparse matrix is not a lower triangle with its diagonal",
                   "build it with PatternBuilder"};
  auto factor = std::make_unique<Factor>();
  auto& matrix = factor->matrix;
  const auto n = static_cast<Eigen::Index>(size);
  matrix.resize(n, n);
  matrix.resizeNonZeros(static_cast<Eigen::Index>(rows.size()));
  std::copy(starts.begin(), starts.end(), matrix.outerIndexPtr());
  std::copy(rows.begin(), rows.end(), matrix.innerIndexPtr());
  std::fill(matrix.valuePtr(), matrix.valuePtr() + rows.size(), Number(0));
  factor->factor.cholmod().print = 0;  // library code never prints
  factor->factor.analyzePattern(matrix);
  return PatternSystem(std::move(factor));
}

template <class Number>
Result<void> PatternSystem<Number>::factorize(const std::vector<Number>& values) {
  STRATAFLOW_ASSERT(values.size() == static_cast<std::size_t>(factor_->matrix.nonZeros()), "values of another pattern");
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(std::real(values[i])) || !std::isfinite(std::imag(values[i])))
      return Failure{FailureCode::invalid_input, "matrix value " + std::to_string(i) + " is not finite",
                     "check the geometry the system was built from"};
  std::copy(values.begin(), values.end(), factor_->matrix.valuePtr());
  factor_->factor.factorize(factor_->matrix);
  // LDLᵀ goes through on an indefinite matrix; its determinant's sign pattern tells.
  if (factor_->factor.info() != Eigen::Success || !std::isfinite(std::real(factor_->factor.logDeterminant())))
    return Failure{FailureCode::geometry_failed, "the linear system has no unique solution",
                   "fix or constrain at least one point of every connected piece"};
  return {};
}

template <class Number>
std::vector<Number> PatternSystem<Number>::solve(const std::vector<Number>& b) const {
  using Vector = Eigen::Matrix<Number, Eigen::Dynamic, 1>;
  STRATAFLOW_ASSERT(b.size() == static_cast<std::size_t>(factor_->matrix.rows()), "right-hand side of another size");
  const Eigen::Map<const Vector> right(b.data(), static_cast<Eigen::Index>(b.size()));
  const Vector x = factor_->factor.solve(right);
  return {x.data(), x.data() + x.size()};
}

template class PatternSystem<double>;
template class PatternSystem<std::complex<double>>;

std::size_t PatternBuilder::add(std::uint32_t row, std::uint32_t column) {
  STRATAFLOW_ASSERT(row < size_ && column < size_, "entry outside the matrix");
  rows_.push_back(std::max(row, column));
  columns_.push_back(std::min(row, column));
  return rows_.size() - 1;
}

void PatternBuilder::finish(std::vector<std::uint32_t>& starts, std::vector<std::uint32_t>& rows,
                            std::vector<std::uint32_t>& slots) {
  for (std::uint32_t i = 0; i < size_; ++i) add(i, i);
  // Two counting sorts, by row and then by column.
  const std::size_t count = rows_.size();
  std::vector<std::uint32_t> by_row(count), order(count), place(size_ + 1);
  const auto sorted_by = [&](const std::vector<std::uint32_t>& key, auto from, std::vector<std::uint32_t>& to) {
    place.assign(size_ + 1, 0);
    for (std::size_t i = 0; i < count; ++i) ++place[key[i] + 1];
    for (std::uint32_t i = 0; i < size_; ++i) place[i + 1] += place[i];
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t entry = from(i);
      to[place[key[entry]]++] = entry;
    }
  };
  sorted_by(rows_, [](std::size_t i) { return static_cast<std::uint32_t>(i); }, by_row);
  sorted_by(columns_, [&](std::size_t i) { return by_row[i]; }, order);
  starts.assign(size_ + 1, 0);
  rows.clear();
  slots.assign(count, 0);
  std::uint32_t last_row = 0, last_column = size_;
  for (const std::uint32_t entry : order) {
    if (rows_[entry] != last_row || columns_[entry] != last_column) {
      rows.push_back(last_row = rows_[entry]);
      ++starts[(last_column = columns_[entry]) + 1];
    }
    slots[entry] = static_cast<std::uint32_t>(rows.size() - 1);
  }
  for (std::uint32_t i = 0; i < size_; ++i) starts[i + 1] += starts[i];
  slots.resize(count - size_);
  rows_.clear();
  columns_.clear();
}

}  // namespace strataflow
