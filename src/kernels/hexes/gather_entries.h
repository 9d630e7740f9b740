#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "graph/parallel/parallel_map.h"
#include "kernels/adapters/sparse/symmetric_system.h"

namespace strataflow {

/// The matrix entries that all items give, in the order of the items: give(item, entries) appends an item's. The same
/// bits on every schedule.
template <class Give>
std::vector<MatrixEntry> gather_entries(std::size_t count, Give&& give) {
  constexpr std::size_t grain = 16384;
  std::vector<std::vector<MatrixEntry>> parts((count + grain - 1) / grain);
  parallel_ranges(count, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t item = begin; item < end; ++item) give(item, parts[begin / grain]);
  });
  std::vector<std::size_t> first{0};
  for (const auto& part : parts) first.push_back(first.back() + part.size());
  std::vector<MatrixEntry> entries(first.back());
  parallel_ranges(parts.size(), 1, [&](std::size_t p, std::size_t) {
    std::copy(parts[p].begin(), parts[p].end(), entries.begin() + static_cast<std::ptrdiff_t>(first[p]));
    parts[p] = {};
  });
  return entries;
}

}  // namespace strataflow
