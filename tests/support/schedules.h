#pragma once
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <cstdint>
#include <functional>

#include "graph/parallel/schedule.h"

namespace strataflow::support {

/// Runs `body` serially, on 1, 2, 3 and 8 threads, and under `shuffles` shuffled schedules, telling it which.
inline void on_every_schedule(const std::function<void(const char*)>& body, std::uint64_t shuffles = 5) {
  {
    const ScheduleScope scope(ScheduleKind::serial);
    body("serial");
  }
  for (const int threads : {1, 2, 3, 8}) {
    const oneapi::tbb::global_control allowed(oneapi::tbb::global_control::max_allowed_parallelism,
                                              static_cast<std::size_t>(threads));
    oneapi::tbb::task_arena arena(threads);
    const ScheduleScope scope(ScheduleKind::threads);
    arena.execute([&] { body("threads"); });
  }
  for (std::uint64_t seed = 0; seed < shuffles; ++seed) {
    const ScheduleScope scope(ScheduleKind::shuffled, seed);
    body("shuffled");
  }
}

}  // namespace strataflow::support
