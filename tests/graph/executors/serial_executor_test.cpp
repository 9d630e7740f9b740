#include "graph/executors/serial_executor.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

TEST(SerialExecutor, tasks_and_chunks_run_in_order) {
  TaskOrder order{{0, 0, 1}, {{2}, {}, {}}};
  std::vector<std::size_t> seen;
  auto task = [&](std::size_t i) {
    auto chunk = [&](std::size_t j) { seen.push_back(10 * i + j); };
    run_chunks(3, chunk);
  };
  run_tasks_in_order(order, task);
  EXPECT_EQ(seen, (std::vector<std::size_t>{0, 1, 2, 10, 11, 12, 20, 21, 22}));
}

}  // namespace
}  // namespace strataflow
