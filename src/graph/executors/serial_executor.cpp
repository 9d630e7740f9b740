#include "graph/executors/serial_executor.h"

namespace strataflow {

void run_tasks_in_order(const TaskOrder& order, ChunkBody task) {
  const ScheduleScope scope(ScheduleKind::serial);
  for (std::uint32_t i = 0; i < order.task_count(); ++i) task(i);  // consumers come after their inputs
}

}  // namespace strataflow
