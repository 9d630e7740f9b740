#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/cancellation.h"
#include "base/result.h"

namespace strataflow {

/// How a child process ended and what it wrote to its standard output.
struct ChildOutcome {
  std::vector<std::byte> output;
  int exit_code = 0;   ///< meaningful when it exited by itself
  int signal = 0;      ///< the signal that ended it, 0 if none
  bool timed_out = false;
  bool cancelled = false;
  bool is_success() const { return exit_code == 0 && signal == 0 && !timed_out && !cancelled; }
};

/// Runs `program` with `arguments`, feeds `input` to its standard input and collects its standard output; its
/// standard error is discarded. After `timeout_s` seconds, or when `cancellation` is asked for, it is killed.
/// Workers ask the kernel to end with their parent. Safe to call from several threads at once.
/// Fails with internal_error only when no process can be started.
Result<ChildOutcome> run_child_process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                       std::span<const std::byte> input, double timeout_s,
                                       const CancellationToken* cancellation = nullptr);

/// The folder of the running executable, where the worker programs sit.
std::filesystem::path program_folder();

}  // namespace strataflow
