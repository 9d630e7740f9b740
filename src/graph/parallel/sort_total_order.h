#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "graph/parallel/parallel_map.h"

namespace strataflow {

/// Sorts by `less`, which must be a total order: two different elements never compare equal (end it in an id), so
/// there is one right answer and the schedule cannot show.
template <class T, class Allocator, class Less>
void sort_total_order(std::vector<T, Allocator>& values, Less less) {
  constexpr std::size_t run = 16384;
  const std::size_t count = values.size();
  parallel_ranges(count, run, [&](std::size_t begin, std::size_t end) {
    std::sort(values.begin() + static_cast<std::ptrdiff_t>(begin), values.begin() + static_cast<std::ptrdiff_t>(end),
              less);
  });
  std::vector<T, Allocator> merged(count > run ? count : 0);
  for (std::size_t width = run; width < count; width *= 2) {
    parallel_ranges(count, 2 * width, [&](std::size_t begin, std::size_t end) {
      const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
      const auto middle = values.begin() + static_cast<std::ptrdiff_t>(std::min(begin + width, end));
      const auto last = values.begin() + static_cast<std::ptrdiff_t>(end);
      std::merge(first, middle, middle, last, merged.begin() + static_cast<std::ptrdiff_t>(begin), less);
    });
    values.swap(merged);
  }
}

}  // namespace strataflow
