#include "graph/executors/tbb_executor.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <mutex>

#include "graph/parallel/tsan_annotations.h"

namespace strataflow {

namespace {

class ThreadedRun {
 public:
  ThreadedRun(const TaskOrder& order, ChunkBody task) : order_(order), task_(task), pending_(order.task_count()) {
    for (std::uint32_t i = 0; i < order.task_count(); ++i) pending_[i] = order.input_count[i];
  }

  void run() {
    join_.before_fork();
    for (std::uint32_t i = 0; i < order_.task_count(); ++i)
      if (order_.input_count[i] == 0) offer(i);
    group_.wait();
    join_.after_join();
  }

 private:
  /// Every offer spawns one step and every step takes one task: the lowest there is by then.
  void offer(std::uint32_t task) {
    {
      const std::lock_guard lock(mutex_);
      ready_.push_back(task);
      std::push_heap(ready_.begin(), ready_.end(), std::greater<>{});
    }
    group_.run([this] { step(); });
  }
  std::uint32_t take() {
    const std::lock_guard lock(mutex_);
    std::pop_heap(ready_.begin(), ready_.end(), std::greater<>{});
    const std::uint32_t task = ready_.back();
    ready_.pop_back();
    return task;
  }
  void step() {
    join_.begin_task();
    const std::uint32_t task = take();
    // A task that waits for its own loop must not start another task meanwhile: that one could need a lock this one
    // holds, and its time would be counted twice.
    oneapi::tbb::this_task_arena::isolate([&] { task_(task); });
    for (const std::uint32_t consumer : order_.consumers[task])
      if (pending_[consumer].fetch_sub(1, std::memory_order_acq_rel) == 1) offer(consumer);
    join_.end_task();
  }

  const TaskOrder& order_;
  ChunkBody task_;
  std::vector<std::atomic<std::uint32_t>> pending_;
  std::mutex mutex_;
  std::vector<std::uint32_t> ready_;
  TsanJoin join_;
  oneapi::tbb::task_group group_;
};

}  // namespace

void run_tasks_on_threads(const TaskOrder& order, int threads, ChunkBody task) {
  const ScheduleScope scope(ScheduleKind::threads);
  const int count = threads > 0 ? threads : oneapi::tbb::info::default_concurrency();
  // Without the control an arena silently gets no more threads than there are cores.
  const oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(count));
  oneapi::tbb::task_arena arena(count);
  arena.execute([&] { ThreadedRun(order, task).run(); });
}

}  // namespace strataflow
