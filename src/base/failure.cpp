#include "base/failure.h"

namespace strataflow {

std::string_view to_string(FailureCode code) {
  switch (code) {
    case FailureCode::invalid_usage: return "invalid_usage";
    case FailureCode::invalid_options: return "invalid_options";
    case FailureCode::unreadable_file: return "unreadable_file";
    case FailureCode::malformed_file: return "malformed_file";
    case FailureCode::unsupported: return "unsupported";
    case FailureCode::invalid_input: return "invalid_input";
    case FailureCode::geometry_failed: return "geometry_failed";
    case FailureCode::upstream_failed: return "upstream_failed";
    case FailureCode::cancelled: return "cancelled";
    case FailureCode::timed_out: return "timed_out";
    case FailureCode::write_failed: return "write_failed";
    case FailureCode::internal_error: return "internal_error";
  }
  return "internal_error";
}

std::string describe(const Failure& failure) {
  if (failure.remedy.empty()) return failure.what;
  return failure.what + " (" + failure.remedy + ")";
}

}  // namespace strataflow
