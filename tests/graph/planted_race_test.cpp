// Not a GoogleTest: two chunks write one variable, and the thread sanitizer must say so (exit code 66). If it stays
// silent, the suppressions have become too wide.
#include <atomic>

#include "graph/executors/tbb_executor.h"

int main() {
  using namespace strataflow;
  int shared = 0;
  std::atomic<int> arrived{0};
  auto task = [&](std::size_t) {
    auto chunk = [&](std::size_t) {
      // Both are here before either writes; relaxed, so that this orders nothing.
      arrived.fetch_add(1, std::memory_order_relaxed);
      for (int spin = 0; spin < 100'000'000 && arrived.load(std::memory_order_relaxed) < 2; ++spin) {
      }
      ++shared;
    };
    run_chunks(2, chunk);
  };
  run_tasks_on_threads({{0}, {{}}}, 2, task);
  return shared == 0;
}
