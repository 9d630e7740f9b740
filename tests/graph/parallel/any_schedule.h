#pragma once
#include <cstdint>
#include <functional>

#include "graph/executors/serial_executor.h"
#include "graph/executors/shuffled_executor.h"
#include "graph/executors/tbb_executor.h"

namespace strataflow::support {

/// Calls `check` on every schedule: serial, 1, 2, 3 and 8 threads, and 50 shuffles.
inline void on_every_schedule(const std::function<void()>& check) {
  const TaskOrder one{{0}, {{}}};
  auto task = [&](std::size_t) { check(); };
  run_tasks_in_order(one, task);
  for (const int threads : {1, 2, 3, 8}) run_tasks_on_threads(one, threads, task);
  for (std::uint64_t seed = 0; seed < 50; ++seed) run_tasks_shuffled(one, seed, task);
}

}  // namespace strataflow::support
