#pragma once
#include <complex>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "kernels/adapters/sparse/pattern_system.h"

namespace strataflow {

/// A PatternSystem taken apart into what its pattern leaves unconnected: for a field, the compartments between
/// features. They are ordered, factorised and solved each on its own, in parallel.
template <class Number>
class CompartmentSystem {
 public:
  /// As in PatternSystem.
  static Result<CompartmentSystem> analyse(const std::vector<std::uint32_t>& starts,
                                           const std::vector<std::uint32_t>& rows);
  Result<void> factorize(const std::vector<Number>& values);
  std::vector<Number> solve(const std::vector<Number>& b) const;

  std::size_t compartment_count() const { return systems_.size(); }

 private:
  std::vector<PatternSystem<Number>> systems_;        ///< by their first unknown
  std::vector<std::vector<std::uint32_t>> unknowns_;  ///< per system, ascending
  std::vector<std::vector<std::uint32_t>> entries_;   ///< per system: of the whole matrix, in the system's order
};

extern template class CompartmentSystem<double>;
extern template class CompartmentSystem<std::complex<double>>;

}  // namespace strataflow
