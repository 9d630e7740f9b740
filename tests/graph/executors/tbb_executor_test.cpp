#include "graph/executors/tbb_executor.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <map>
#include <mutex>
#include <set>
#include <thread>

namespace strataflow {
namespace {

TaskOrder independent(std::uint32_t count) {
  return {std::vector<std::uint32_t>(count), std::vector<std::vector<std::uint32_t>>(count)};
}

TEST(TbbExecutor, eight_threads_exist_also_on_fewer_cores) {
  std::mutex mutex;
  std::condition_variable arrived;
  std::set<std::thread::id> threads;
  auto wait_for_all = [&](std::size_t) {
    std::unique_lock lock(mutex);
    threads.insert(std::this_thread::get_id());
    arrived.notify_all();
    arrived.wait_for(lock, std::chrono::seconds(30), [&] { return threads.size() == 8; });
  };
  run_tasks_on_threads(independent(8), 8, wait_for_all);
  EXPECT_EQ(threads.size(), 8u);
}

TEST(TbbExecutor, one_thread_takes_the_lowest_ready_task_first) {
  std::vector<std::size_t> order;
  auto note = [&](std::size_t task) { order.push_back(task); };
  TaskOrder tasks = independent(6);
  tasks.consumers[0] = {4};  // 4 becomes ready before 1 … 3 have run, and waits its turn
  tasks.input_count[4] = 1;
  run_tasks_on_threads(tasks, 1, note);
  EXPECT_EQ(order, (std::vector<std::size_t>{0, 1, 2, 3, 4, 5}));
}

TEST(TbbExecutor, a_task_that_waits_for_its_loop_starts_no_other_task) {
  std::atomic<int> inside{0};
  std::atomic<int> most_per_thread{0};
  std::mutex mutex;
  std::map<std::thread::id, int> depth;
  auto task = [&](std::size_t) {
    {
      const std::lock_guard lock(mutex);
      most_per_thread = std::max(most_per_thread.load(), ++depth[std::this_thread::get_id()]);
    }
    auto chunk = [&](std::size_t) {
      ++inside;
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    };
    run_chunks(8, chunk);
    const std::lock_guard lock(mutex);
    --depth[std::this_thread::get_id()];
  };
  run_tasks_on_threads(independent(50), 3, task);
  EXPECT_EQ(inside, 400);
  EXPECT_EQ(most_per_thread, 1);
}

}  // namespace
}  // namespace strataflow
