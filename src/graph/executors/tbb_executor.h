#pragma once
#include "graph/executors/task_order.h"
#include "graph/parallel/schedule.h"

namespace strataflow {

/// Runs tasks, and the loops inside them, on `threads` threads (0: one per core; more than cores are made if asked
/// for). Among the tasks that may start, the lowest starts first. Tasks must not throw.
void run_tasks_on_threads(const TaskOrder& order, int threads, ChunkBody task);

}  // namespace strataflow
