#pragma once
#include <filesystem>
#include <vector>

#include "batch/report/job_report.h"
#include "batch/run/run_folder.h"

namespace strataflow {

/// Facts about the whole run that no report.json may hold.
struct RunFacts {
  int threads = 1;
  double total_s = 0;
  double peak_memory_mb = 0;
  std::filesystem::path run_folder;
};

/// Every file of a job's run folder (interface.md §3): reports, the resolved job, the log, and the products in all
/// formats the job asks for.
std::vector<RunFile> run_files(const JobReport& report, const RunFacts& facts);

/// What a failed job leaves for inspection: report.json, job.toml, log.txt and, of each stage of the quads that succeeded
/// (or of the plan of hexes, if no quads are made), a VTK file called after it. Empty if none of them did, or the quads
/// are not what failed.
std::vector<RunFile> inspection_files(const JobReport& report, const RunFacts& facts);

}  // namespace strataflow
