#include "graph/parallel/schedule.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <numeric>
#include <vector>

#include "base/internal_error.h"
#include "base/seed.h"
#include "graph/parallel/tsan_annotations.h"

namespace strataflow {

namespace {

std::atomic<ScheduleKind> current_kind{ScheduleKind::threads};
std::atomic<std::uint64_t> current_seed{0};
std::atomic<bool> scope_exists{false};

/// The exception of the lowest failing chunk.
class FirstFailure {
 public:
  void record(std::size_t chunk) {
    const std::lock_guard lock(mutex_);
    if (!exception_ || chunk < chunk_) {
      exception_ = std::current_exception();
      chunk_ = chunk;
    }
  }
  void rethrow_if_any() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr exception_;
  std::size_t chunk_ = 0;
};

void run_guarded(ChunkBody body, std::size_t chunk, FirstFailure& failure) {
  try {
    body(chunk);
  } catch (...) {
    failure.record(chunk);
  }
}

}  // namespace

ScheduleScope::ScheduleScope(ScheduleKind kind, std::uint64_t shuffle_seed) {
  STRATAFLOW_ASSERT(!scope_exists.exchange(true), "two schedules at once");
  current_kind = kind;
  current_seed = shuffle_seed;
}

ScheduleScope::~ScheduleScope() {
  current_kind = ScheduleKind::threads;
  scope_exists = false;
}

void run_chunks(std::size_t chunk_count, ChunkBody body) {
  FirstFailure failure;
  switch (current_kind.load()) {
    case ScheduleKind::serial:
      for (std::size_t chunk = 0; chunk < chunk_count; ++chunk) run_guarded(body, chunk, failure);
      break;
    case ScheduleKind::shuffled: {
      std::vector<std::size_t> order(chunk_count);
      std::iota(order.begin(), order.end(), std::size_t{0});
      RandomStream random(mix64(current_seed++));
      for (std::size_t i = chunk_count; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
      for (const std::size_t chunk : order) run_guarded(body, chunk, failure);
      break;
    }
    case ScheduleKind::threads: {
      if (chunk_count == 1) {
        run_guarded(body, 0, failure);
        break;
      }
      TsanJoin join;
      join.before_fork();
      oneapi::tbb::parallel_for(
          oneapi::tbb::blocked_range<std::size_t>(0, chunk_count, 1),
          [&](const oneapi::tbb::blocked_range<std::size_t>& range) {
            join.begin_task();
            for (std::size_t chunk = range.begin(); chunk != range.end(); ++chunk) run_guarded(body, chunk, failure);
            join.end_task();
          },
          oneapi::tbb::simple_partitioner{});
      join.after_join();
      break;
    }
  }
  failure.rethrow_if_any();
}

}  // namespace strataflow
