#include "graph/executors/shuffled_executor.h"

#include <utility>

#include "base/seed.h"

namespace strataflow {

void run_tasks_shuffled(const TaskOrder& order, std::uint64_t seed, ChunkBody task) {
  const ScheduleScope scope(ScheduleKind::shuffled, seed);
  RandomStream random(mix64(seed));
  std::vector<std::uint32_t> pending = order.input_count;
  std::vector<std::uint32_t> ready;
  for (std::uint32_t i = 0; i < order.task_count(); ++i)
    if (pending[i] == 0) ready.push_back(i);
  while (!ready.empty()) {
    std::swap(ready[random.below(ready.size())], ready.back());
    const std::uint32_t chosen = ready.back();
    ready.pop_back();
    task(chosen);
    for (const std::uint32_t consumer : order.consumers[chosen])
      if (--pending[consumer] == 0) ready.push_back(consumer);
  }
}

}  // namespace strataflow
