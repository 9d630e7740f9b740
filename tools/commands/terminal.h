#pragma once
#include <string_view>

#include "base/failure.h"

namespace strataflow {

/// Writes to standard output, the place of results. The exit code: 1, with a message, when the result is lost to a full
/// disk or the like; a reader that has seen enough (head) is no failure.
[[nodiscard]] int print_result(std::string_view text);

/// Writes a failure to standard error and returns the exit code for it.
int report_failure(const Failure& failure);

/// One line of warning to standard error.
void report_warning(std::string_view text);

/// 1, 2 or 70: whose fault it is.
int exit_code_of(FailureCode code);

/// True if colours and a moving progress line make sense on standard error.
bool is_stderr_terminal();

/// Writes to standard error as it is.
void print_progress(std::string_view text);

}  // namespace strataflow
