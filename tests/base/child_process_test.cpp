#include "base/child_process.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace strataflow {
namespace {

std::span<const std::byte> as_bytes(const std::string& text) {
  return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

TEST(ChildProcess, passes_a_megabyte_through) {
  const std::string input(1 << 20, 'x');
  const auto outcome = run_child_process("/bin/cat", {}, as_bytes(input), 20);
  ASSERT_TRUE(outcome);
  EXPECT_TRUE(outcome->is_success());
  EXPECT_EQ(outcome->output.size(), input.size());
}

TEST(ChildProcess, tells_an_exit_code_from_a_signal) {
  const auto code = run_child_process("/bin/sh", {"-c", "exit 3"}, {}, 20);
  ASSERT_TRUE(code);
  EXPECT_EQ(code->exit_code, 3);
  const auto signal = run_child_process("/bin/sh", {"-c", "kill -SEGV $$"}, {}, 20);
  ASSERT_TRUE(signal);
  EXPECT_EQ(signal->signal, SIGSEGV);
  EXPECT_FALSE(signal->is_success());
}

TEST(ChildProcess, survives_a_child_that_does_not_read) {
  const std::string input(1 << 22, 'x');
  const auto outcome = run_child_process("/bin/true", {}, as_bytes(input), 20);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->exit_code, 0);
}

TEST(ChildProcess, is_killed_at_its_time_limit) {
  const auto begin = std::chrono::steady_clock::now();
  const auto outcome = run_child_process("/bin/sleep", {"60"}, {}, 0.2);
  ASSERT_TRUE(outcome);
  EXPECT_TRUE(outcome->timed_out);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

TEST(ChildProcess, is_killed_at_its_time_limit_though_its_output_is_closed) {
  const auto begin = std::chrono::steady_clock::now();
  const auto outcome = run_child_process("/bin/sh", {"-c", "printf done; exec sleep 60 >&-"}, {}, 0.3);
  ASSERT_TRUE(outcome);
  EXPECT_TRUE(outcome->timed_out);
  EXPECT_EQ(outcome->output.size(), 4u);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

TEST(ChildProcess, may_work_on_after_closing_its_output) {
  const auto outcome = run_child_process("/bin/sh", {"-c", "exec >&-; sleep 0.2; exit 5"}, {}, 20);
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->exit_code, 5);
  EXPECT_FALSE(outcome->timed_out);
}

TEST(ChildProcess, a_time_limit_past_the_clocks_range_is_no_limit) {
  const auto outcome = run_child_process("/bin/sleep", {"0.3"}, {}, 1e300);
  ASSERT_TRUE(outcome);
  EXPECT_TRUE(outcome->is_success());
}

TEST(ChildProcess, is_killed_on_cancellation) {
  CancellationToken token;
  std::thread later([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    token.cancel();
  });
  const auto outcome = run_child_process("/bin/sleep", {"60"}, {}, 60, &token);
  later.join();
  ASSERT_TRUE(outcome);
  EXPECT_TRUE(outcome->cancelled);
}

TEST(ChildProcess, a_missing_program_is_named) {
  const auto outcome = run_child_process("/nowhere/worker", {}, {}, 1);
  ASSERT_FALSE(outcome);
  EXPECT_NE(outcome.failure().what.find("/nowhere/worker"), std::string::npos);
}

}  // namespace
}  // namespace strataflow
