#pragma once
#include <cstddef>
#include <vector>

#include "graph/parallel/parallel_map.h"

namespace strataflow {

/// Items per leaf. Part of the numeric result: changing it changes goldens.
inline constexpr std::size_t reduce_grain = 4096;

/// combine(… combine(identity, leaf(0)) …, leaf(count − 1)) with one fixed bracketing, whatever the schedule: every
/// `reduce_grain` items are folded from the left, then the folds from the left. The only floating-point reduction.
template <class T, class Leaf, class Combine>
T ordered_reduce(std::size_t count, T identity, Leaf leaf, Combine combine) {
  const std::size_t blocks = (count + reduce_grain - 1) / reduce_grain;
  const std::vector<T> partial = parallel_map(blocks, [&](std::size_t block) {
    T value = identity;
    const std::size_t end = std::min(count, (block + 1) * reduce_grain);
    for (std::size_t i = block * reduce_grain; i < end; ++i) value = combine(value, leaf(i));
    return value;
  });
  T value = identity;
  for (const T& part : partial) value = combine(value, part);
  return value;
}

}  // namespace strataflow
