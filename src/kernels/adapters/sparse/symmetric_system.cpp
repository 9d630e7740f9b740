#include "kernels/adapters/sparse/symmetric_system.h"

#include <Eigen/CholmodSupport>
#include <Eigen/SparseCore>

#include <cmath>
#include <string>

namespace strataflow {

struct SymmetricSystem::Factor {
  Eigen::CholmodSimplicialLDLT<Eigen::SparseMatrix<double>> factor;
  std::uint32_t size = 0;
};

SymmetricSystem::SymmetricSystem(std::unique_ptr<Factor> factor) : factor_(std::move(factor)) {}
SymmetricSystem::SymmetricSystem(SymmetricSystem&&) noexcept = default;
SymmetricSystem& SymmetricSystem::operator=(SymmetricSystem&&) noexcept = default;
SymmetricSystem::~SymmetricSystem() = default;

Result<SymmetricSystem> SymmetricSystem::factorize(std::uint32_t size, const std::vector<MatrixEntry>& lower) {
  std::vector<Eigen::Triplet<double>> triplets;
  triplets.reserve(lower.size());
  for (const MatrixEntry& entry : lower) {
    if (entry.row >= size || entry.column > entry.row || !std::isfinite(entry.value))
      return Failure{FailureCode::invalid_input,
                     "matrix entry (" + std::to_string(entry.row) + ", " + std::to_string(entry.column) +
                         ") is not finite or not in the lower triangle",
                     "check the constraints the system was built from"};
    triplets.emplace_back(static_cast<int>(entry.row), static_cast<int>(entry.column), entry.value);
  }
  Eigen::SparseMatrix<double> matrix(size, size);
  matrix.setFromTriplets(triplets.begin(), triplets.end());
  auto factor = std::make_unique<Factor>();
  factor->size = size;
  factor->factor.cholmod().print = 0;  // library code never prints
  factor->factor.compute(matrix);
  // LDLᵀ goes through on an indefinite matrix; its determinant's sign pattern tells.
  if (factor->factor.info() != Eigen::Success || !std::isfinite(factor->factor.logDeterminant()))
    return Failure{FailureCode::geometry_failed, "the linear system has no unique solution",
                   "fix or constrain at least one point of every connected piece"};
  return SymmetricSystem(std::move(factor));
}

std::vector<double> SymmetricSystem::solve(const std::vector<double>& b) const {
  STRATAFLOW_ASSERT(b.size() == factor_->size, "right-hand side of another size");
  const Eigen::Map<const Eigen::VectorXd> right(b.data(), static_cast<Eigen::Index>(b.size()));
  const Eigen::VectorXd x = factor_->factor.solve(right);
  return {x.data(), x.data() + x.size()};
}

}  // namespace strataflow
