#pragma once
#include <cstdint>

#include "graph/executors/task_order.h"
#include "graph/parallel/schedule.h"

namespace strataflow {

/// Runs one task at a time, always a random one of those that may start, with the chunks of the loops inside them in
/// random order too: what leans on an order gives another result. Tasks must not throw.
void run_tasks_shuffled(const TaskOrder& order, std::uint64_t seed, ChunkBody task);

}  // namespace strataflow
