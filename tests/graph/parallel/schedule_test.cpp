#include "graph/parallel/schedule.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "base/internal_error.h"
#include "graph/parallel/any_schedule.h"

namespace strataflow {
namespace {

TEST(RunChunks, each_chunk_runs_once_on_every_schedule) {
  support::on_every_schedule([] {
    std::vector<int> runs(1000);
    auto chunk = [&](std::size_t i) { ++runs[i]; };
    run_chunks(runs.size(), chunk);
    EXPECT_EQ(runs, std::vector<int>(1000, 1));
  });
}

TEST(RunChunks, the_exception_of_the_lowest_chunk_is_thrown_and_the_others_run) {
  support::on_every_schedule([] {
    std::vector<int> runs(64);
    auto chunk = [&](std::size_t i) {
      ++runs[i];
      if (i % 10 == 7) throw std::runtime_error(std::to_string(i));
    };
    try {
      run_chunks(runs.size(), chunk);
      ADD_FAILURE() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "7");
    }
    EXPECT_EQ(runs, std::vector<int>(64, 1));
  });
}

TEST(RunChunks, no_chunks_is_fine) {
  auto chunk = [](std::size_t) { FAIL(); };
  run_chunks(0, chunk);
}

TEST(ScheduleScope, two_at_once_are_our_bug) {
  const ScheduleScope scope(ScheduleKind::serial);
  EXPECT_THROW(ScheduleScope(ScheduleKind::threads), InternalError);
}

}  // namespace
}  // namespace strataflow
