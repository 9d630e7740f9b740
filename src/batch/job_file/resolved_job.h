#pragma once
#include <filesystem>
#include <string>

#include "batch/job_file/job.h"

namespace strataflow {

/// The job as a job file that leaves nothing to defaults. Input paths are relative to `run_folder`, where it will lie;
/// running it again gives the same digests. Sweeps are resolved: it is the one job.
std::string resolved_job_text(const Job& job, const std::filesystem::path& run_folder);

}  // namespace strataflow
