#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

namespace strataflow {

/// The different values, ascending.
inline std::vector<std::uint32_t> sorted_unique(std::vector<std::uint32_t> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}  // namespace strataflow
