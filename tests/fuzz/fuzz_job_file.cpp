#include <cstddef>
#include <cstdint>
#include <string_view>

#include "base/internal_error.h"
#include "batch/job_file/job.h"
#include "batch/job_file/resolved_job.h"

/// Whatever the bytes: jobs, or a named failure with a remedy; and a job that was read reads again from its resolved
/// form as the same job.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace strataflow;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const Result<std::vector<Job>> jobs = read_jobs_from_text(text, "fuzz.toml", "/nowhere");
  if (!jobs) {
    STRATAFLOW_ASSERT(!jobs.failure().what.empty() && !jobs.failure().remedy.empty(), "a failure without words");
    return 0;
  }
  STRATAFLOW_ASSERT(!jobs->empty(), "no job and no failure");
  for (std::size_t i = 0; i < jobs->size() && i < 3; ++i) {
    const std::string resolved = resolved_job_text((*jobs)[i], "/nowhere/out");
    const Result<std::vector<Job>> again = read_jobs_from_text(resolved, "again.toml", "/nowhere/out");
    STRATAFLOW_ASSERT(again, "the resolved job does not read: " + again.failure().what);
    STRATAFLOW_ASSERT(resolved_job_text(again->front(), "/nowhere/out") == resolved,
                      "the resolved job reads differently");
  }
  return 0;
}
