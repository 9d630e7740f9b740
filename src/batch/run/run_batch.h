#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/cancellation.h"
#include "base/failure.h"
#include "batch/job_file/job.h"
#include "graph/run_graph.h"

namespace strataflow {

struct BatchOptions {
  /// One job: its run folder. Several: the folder their run folders lie in. Absent: out/<name> beside each job file.
  std::optional<std::filesystem::path> out;
  RunOptions run;  ///< `wanted` is filled in by run_batch
};

/// What became of one job of a batch.
struct JobOutcome {
  std::string name;
  std::filesystem::path run_folder;  ///< written exactly when there is no failure
  std::optional<Failure> failure;
  std::vector<std::string> warnings;  ///< "node: kind: what"
};

/// Runs all jobs as one graph and writes a run folder for each that succeeds; a failed job leaves its folder as it was,
/// and the others go on. Where quads could not be made, what the stages before left is written whole beside it, to a
/// folder of the same name with ".failed" that the message names; the next success removes it. If several succeed, comparison.html, beside the first run folder, sets them side by side.
/// Outcomes are in the order of `jobs`. Fails before any work with invalid_usage (two jobs with
/// the same run folder, an unknown stage to stop after, a folder that is no run folder) or write_failed.
Result<std::vector<JobOutcome>> run_batch(const std::vector<Job>& jobs, const BatchOptions& options);

/// Most memory held at once so far by this process, plus by its largest child, in 1e6 bytes.
double peak_memory_mb();

}  // namespace strataflow
