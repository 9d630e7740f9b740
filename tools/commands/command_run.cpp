#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <memory>

#include "batch/run/run_batch.h"
#include "commands.h"
#include "graph/stage_store.h"
#include "progress_printer.h"
#include "terminal.h"

namespace strataflow {

namespace {

Result<void> set_executor(const std::string& text, RunOptions& run) {
  const std::string prefix = "shuffled:";
  if (text == "tbb") {
    run.executor = ExecutorKind::tbb;
  } else if (text == "serial") {
    run.executor = ExecutorKind::serial;
  } else if (text.starts_with(prefix)) {
    run.executor = ExecutorKind::shuffled;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + prefix.size(), end, run.shuffle_seed);
    if (error == std::errc() && stop == end) return {};
    return Failure{FailureCode::invalid_usage, "--executor " + text + ": the seed is not a whole number",
                   "for instance shuffled:7"};
  } else {
    return Failure{FailureCode::invalid_usage, "--executor " + text + ": unknown executor",
                   "tbb, serial or shuffled:SEED"};
  }
  return {};
}

/// ~/.cache/strataflow, or where XDG_CACHE_HOME says. Nothing without a home: then there is no store.
std::optional<std::filesystem::path> default_cache() {
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache && *cache == '/')
    return std::filesystem::path(cache) / "strataflow";  // the rule: relative ones are ignored
  const char* home = std::getenv("HOME");
  if (home && *home) return std::filesystem::path(home) / ".cache" / "strataflow";
  return std::nullopt;
}

Result<std::unique_ptr<StageStore>> open_store(const RunArguments& arguments) {
  const std::optional<std::filesystem::path> folder = arguments.cache ? arguments.cache : default_cache();
  if (arguments.no_cache || !folder) return std::unique_ptr<StageStore>();
  Result<std::unique_ptr<StageStore>> store = StageStore::open(*folder);
  if (store || arguments.cache) return store;
  // Nobody asked for the default place: a read-only home is no reason to fail.
  report_warning("no store: " + store.failure().what);
  return std::unique_ptr<StageStore>();
}

}  // namespace

int run_command(const RunArguments& arguments, const CancellationToken& cancellation) {
  std::vector<Job> jobs;
  for (const std::filesystem::path& file : arguments.jobs) {
    Result<std::vector<Job>> read = read_jobs(file, arguments.settings);
    if (!read) {
      (void)report_failure(read.failure());
      return 2;  // a job file that is missing is wrong usage too
    }
    for (Job& job : *read) jobs.push_back(std::move(job));
  }
  BatchOptions options;
  options.out = arguments.out;
  options.run.threads = arguments.threads;
  options.run.stop_after = arguments.stop_after;
  options.run.cancellation = &cancellation;
  if (const Result<void> set = set_executor(arguments.executor, options.run); !set)
    return report_failure(set.failure());
  const Result<std::unique_ptr<StageStore>> store = open_store(arguments);
  if (!store) return report_failure(store.failure());
  options.run.store = store->get();
  ProgressPrinter progress(arguments.quiet ? "none" : arguments.progress);
  options.run.progress = &progress;

  const Result<std::vector<JobOutcome>> outcomes = run_batch(jobs, options);
  progress.clear();
  if (!outcomes) return report_failure(outcomes.failure());
  int exit_code = 0;
  for (const JobOutcome& job : *outcomes) {
    if (!arguments.quiet)
      for (const std::string& warning : job.warnings) report_warning(job.name + ": " + warning);
    if (job.failure) {
      Failure failure = *job.failure;
      failure.what = job.name + ": " + failure.what;
      exit_code = std::max(exit_code, report_failure(failure));
    } else if (!arguments.quiet) {
      exit_code = std::max(exit_code, print_result(job.run_folder.string() + "\n"));
    }
  }
  return exit_code;
}

}  // namespace strataflow
