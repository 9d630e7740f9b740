#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

namespace strataflow {

/// The different values, ascending.
template <typename Value = std::uint32_t>
std::vector<Value> sorted_unique(std::vector<Value> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}  // namespace strataflow
