#include "kernels/quads/field/compartment_system.h"

#include <optional>

#include "base/id.h"
#include "graph/parallel/parallel_map.h"
#include "kernels/topology/union_find.h"

namespace strataflow {

template <class Number>
Result<CompartmentSystem<Number>> CompartmentSystem<Number>::analyse(const std::vector<std::uint32_t>& starts,
                                                                     const std::vector<std::uint32_t>& rows) {
  const auto size = static_cast<std::uint32_t>(starts.empty() ? 0 : starts.size() - 1);
  for (const std::uint32_t row : rows)
    if (row >= size || starts.back() != rows.size())
      return Failure{FailureCode::invalid_input, "the pattern of a sparse matrix has a row that is not there",
                     "build it with PatternBuilder"};
  UnionFind connected(size);
  for (std::uint32_t c = 0; c < size; ++c)
    for (std::uint32_t i = starts[c]; i < starts[c + 1]; ++i) connected.unite(c, rows[i]);
  CompartmentSystem system;
  std::vector<std::uint32_t> number(size, no_index), place(size);
  for (std::uint32_t c = 0; c < size; ++c) {
    std::uint32_t& compartment = number[connected.find(c)];
    if (compartment == no_index) {
      compartment = static_cast<std::uint32_t>(system.unknowns_.size());
      system.unknowns_.emplace_back();
    }
    place[c] = static_cast<std::uint32_t>(system.unknowns_[compartment].size());
    system.unknowns_[compartment].push_back(c);
  }
  system.entries_.resize(system.unknowns_.size());
  auto parts = parallel_map(system.unknowns_.size(), [&](std::size_t k) {
    std::vector<std::uint32_t> own_starts{0}, own_rows;
    for (const std::uint32_t c : system.unknowns_[k]) {
      for (std::uint32_t i = starts[c]; i < starts[c + 1]; ++i) {
        own_rows.push_back(place[rows[i]]);
        system.entries_[k].push_back(i);
      }
      own_starts.push_back(static_cast<std::uint32_t>(own_rows.size()));
    }
    return std::optional(PatternSystem<Number>::analyse(std::move(own_starts), std::move(own_rows)));
  });
  for (auto& part : parts) {
    if (!*part) return part->failure();
    system.systems_.push_back(std::move(**part));
  }
  return system;
}

template <class Number>
Result<void> CompartmentSystem<Number>::factorize(const std::vector<Number>& values) {
  const auto done = parallel_map(systems_.size(), [&](std::size_t k) {
    std::vector<Number> own;
    own.reserve(entries_[k].size());
    for (const std::uint32_t i : entries_[k]) own.push_back(values[i]);
    return std::optional(systems_[k].factorize(own));
  });
  for (const auto& result : done)
    if (!*result) return result->failure();
  return {};
}

template <class Number>
std::vector<Number> CompartmentSystem<Number>::solve(const std::vector<Number>& b) const {
  std::vector<Number> x(b.size());
  parallel_ranges(systems_.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      std::vector<Number> own;
      for (const std::uint32_t i : unknowns_[k]) own.push_back(b[i]);
      own = systems_[k].solve(own);
      for (std::size_t j = 0; j < own.size(); ++j) x[unknowns_[k][j]] = own[j];
    }
  });
  return x;
}

template class CompartmentSystem<double>;
template class CompartmentSystem<std::complex<double>>;

}  // namespace strataflow
