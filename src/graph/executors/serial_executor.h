#pragma once
#include "graph/executors/task_order.h"
#include "graph/parallel/schedule.h"

namespace strataflow {

/// Runs task(0), task(1), …, with the loops inside them in order too. Tasks must not throw.
void run_tasks_in_order(const TaskOrder& order, ChunkBody task);

}  // namespace strataflow
