#pragma once
#include <string>
#include <string_view>

namespace strataflow {

/// Whose fault and of which kind. The text form (`to_string`) is part of report.json.
enum class FailureCode {
  invalid_usage,     ///< wrong command line or job file (exit 2)
  invalid_options,   ///< an option out of its domain, or two that contradict each other (exit 2)
  unreadable_file,   ///< missing, a directory, no permission
  malformed_file,    ///< not of the format it claims, truncated, NaN, index out of range
  unsupported,       ///< understood, but not something we do
  invalid_input,     ///< readable, but not a valid model or mesh
  geometry_failed,   ///< a kernel could not do its work on this geometry
  upstream_failed,   ///< an earlier stage failed
  cancelled,         ///< the user asked us to stop
  timed_out,         ///< a child process took longer than its limit
  write_failed,      ///< disk full, no permission
  internal_error     ///< our bug (exit 70)
};

std::string_view to_string(FailureCode code);

/// What went wrong, said to a person: which entity or file:line and why (`what`), and what to do next (`remedy`).
struct Failure {
  FailureCode code = FailureCode::internal_error;
  std::string what;
  std::string remedy;
};

/// "what (remedy)" on one line.
std::string describe(const Failure& failure);

}  // namespace strataflow
