#pragma once
#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "graph/parallel/schedule.h"

namespace strataflow {

/// Calls body(begin, end) for [0, count) cut into ranges of `grain` items (the last may be shorter). The cut depends
/// on count and grain only. Each item may write its own slots, once, and nothing else.
template <class Body>
void parallel_ranges(std::size_t count, std::size_t grain, Body&& body) {
  auto chunk = [&](std::size_t index) {
    const std::size_t begin = index * grain;
    body(begin, std::min(count, begin + grain));
  };
  run_chunks((count + grain - 1) / grain, chunk);
}

/// [item(0), …, item(count − 1)], results by index. `grain` items share a task: leave 1 where an item is worth a task
/// of its own (more than about 10 µs).
template <class Item>
auto parallel_map(std::size_t count, Item&& item, std::size_t grain = 1) {
  using Value = std::decay_t<decltype(item(std::size_t{0}))>;
  static_assert(!std::is_same_v<Value, bool>, "vector<bool> packs neighbours into one byte: use char");
  std::vector<Value> results(count);
  parallel_ranges(count, grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) results[i] = item(i);
  });
  return results;
}

}  // namespace strataflow
