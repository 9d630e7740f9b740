#pragma once
#include <stdexcept>
#include <string>

namespace strataflow {

/// A broken promise inside strataflow: a bug of ours, never the user's fault. Caught once per node; the run exits 70.
class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

[[noreturn]] void raise_internal_error(const char* condition, const char* file, int line, const std::string& message);

}  // namespace strataflow

/// Checks a promise of ours, in every build. Throws InternalError.
#define STRATAFLOW_ASSERT(condition, message) \
  ((condition) ? (void)0 : ::strataflow::raise_internal_error(#condition, __FILE__, __LINE__, message))
