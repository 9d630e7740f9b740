#pragma once
#include <cstdint>
#include <vector>

namespace strataflow {

/// Which task may start when: task i after the `input_count[i]` tasks that list it as a consumer.
struct TaskOrder {
  std::vector<std::uint32_t> input_count;
  std::vector<std::vector<std::uint32_t>> consumers;  ///< each > its own index, each once

  std::uint32_t task_count() const { return static_cast<std::uint32_t>(input_count.size()); }
};

}  // namespace strataflow
