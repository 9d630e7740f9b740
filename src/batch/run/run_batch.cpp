#include "batch/run/run_batch.h"

#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <map>

#include "base/atomic_file.h"
#include "batch/build_graph.h"
#include "batch/options/closest_word.h"
#include "batch/report/comparison_html.h"
#include "batch/report/job_report.h"
#include "batch/run/run_files.h"
#include "batch/run/run_folder.h"
#include "stages/all_stages.h"

namespace strataflow {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> run_folders(const std::vector<Job>& jobs, const std::optional<fs::path>& out) {
  std::vector<fs::path> folders;
  for (const Job& job : jobs) {
    fs::path folder = !out ? job.folder / "out" / job.header.name : jobs.size() == 1 ? *out : *out / job.header.name;
    folder = fs::absolute(folder).lexically_normal();
    if (!folder.has_filename()) folder = folder.parent_path();  // a trailing slash
    folders.push_back(folder);
  }
  return folders;
}

Result<void> check_folders(const std::vector<Job>& jobs, const std::vector<fs::path>& folders) {
  std::map<fs::path, std::size_t> seen;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    if (const auto [other, is_new] = seen.try_emplace(folders[i], i); !is_new)
      return Failure{
          FailureCode::invalid_usage,
          jobs[other->second].file_name + " and " + jobs[i].file_name + " would both write " + folders[i].string(),
          "give them different names: job.name"};
    if (const Result<void> checked = check_run_folder(folders[i]); !checked) return checked.failure();
    for (const JobInput& input : jobs[i].inputs)
      if (input.file && is_run_file(fs::path(*input.file).filename().string()) &&
          jobs[i].input_path(input).parent_path() == folders[i])
        return Failure{FailureCode::invalid_usage,
                       input.origin + ": the input lies in the run folder it would be replaced in",
                       "choose another --out"};
  }
  return {};
}

Result<void> check_stop(const StageGraph& graph, const std::string& stage) {
  if (stage.empty() || graph.has_stage(stage)) return {};
  std::vector<std::string> names;
  for (const StageNode& node : graph.nodes())
    if (std::find(names.begin(), names.end(), node.stage) == names.end()) names.push_back(node.stage);
  return Failure{FailureCode::invalid_usage, "--stop-after " + stage + ": no job of this run has that stage",
                 suggestion(stage, {names.begin(), names.end()})};
}

JobReport report_of(const Job& job, const WiredJob& wired, const StageGraph& graph, const RunOutcome& outcome) {
  JobReport report;
  report.job = &job;
  std::optional<Failure> upstream;
  for (const auto& [name, id] : wired.nodes) {
    const StageNode& node = graph.node(id);
    report.stages.push_back({name, node.stage, node.version, outcome[id], outcome.timings[id.value]});
    const std::optional<Failure>& failure = outcome[id].failure;
    if (!failure) continue;
    if (failure->code == FailureCode::upstream_failed || failure->code == FailureCode::cancelled)
      upstream = upstream ? upstream : failure;
    else if (!report.error)
      report.error = Failure{failure->code, name + ": " + failure->what, failure->remedy};
  }
  if (!report.error) report.error = upstream;
  const auto output = [&](const auto& port) {
    using Data = std::decay_t<decltype(*outcome.output(*port))>;
    return port ? outcome.output(*port) : std::shared_ptr<const Data>();
  };
  report.model = output(wired.model);
  report.sealed = output(wired.sealed);
  report.validity = output(wired.validity);
  report.model_pictures = output(wired.model_pictures);
  report.sites = output(wired.sites);
  report.diagram = output(wired.diagram);
  report.remeshed = output(wired.remeshed);
  report.surfaces = output(wired.surfaces);
  report.surfaces_validity = output(wired.surfaces_validity);
  report.surfaces_report = output(wired.surfaces_report);
  report.surfaces_pictures = output(wired.surfaces_pictures);
  report.complexity = output(wired.complexity);
  report.hybrid_remeshed = output(wired.hybrid_remeshed);
  report.hybrid_surfaces = output(wired.hybrid_surfaces);
  report.hybrid_surfaces_report = output(wired.hybrid_surfaces_report);
  report.hybrid = output(wired.hybrid);
  report.hybrid_quality = output(wired.hybrid_quality);
  report.hybrid_pictures = output(wired.hybrid_pictures);
  report.plan_problem = output(wired.plan_problem);
  report.frame_field = output(wired.frame_field);
  report.seamless_map = output(wired.seamless_map);
  report.grid = output(wired.grid);
  report.quads = output(wired.quads);
  report.quads_pictures = output(wired.quads_pictures);
  report.upright = output(wired.upright);
  report.layered_space = output(wired.layered_space);
  report.hex_plan_problem = output(wired.hex_plan_problem);
  report.hex_plan = output(wired.hex_plan);
  report.hex_plan_pictures = output(wired.hex_plan_pictures);
  report.smoothed_hexes = output(wired.smoothed_hexes);
  report.hexes = output(wired.hexes);
  report.simulation = output(wired.simulation);
  report.hexes_pictures = output(wired.hexes_pictures);
  report.frames = output(wired.frames);
  report.tets = output(wired.tets);
  report.tets_quality = output(wired.tets_quality);
  report.tets_pictures = output(wired.tets_pictures);
  return report;
}

/// Writes what the stages before a failure left, and says where it is.
void leave_for_inspection(const fs::path& folder, const std::vector<RunFile>& files, Failure& failure) {
  if (files.empty()) return;
  Result<void> written = check_run_folder(folder);
  if (written) written = replace_run_folder(folder, files);
  failure.remedy += written ? "; what the stages before made is in " + folder.string()
                            : "; what the stages before made could not be written: " + written.failure().what;
}

int thread_count(const RunOptions& run) {
  if (run.executor != ExecutorKind::tbb) return 1;
  if (run.threads > 0) return run.threads;
  cpu_set_t cores;  // those this process may use
  return ::sched_getaffinity(0, sizeof cores, &cores) == 0 ? CPU_COUNT(&cores) : 1;
}

}  // namespace

double peak_memory_mb() {
  rusage own{}, children{};
  ::getrusage(RUSAGE_SELF, &own);
  ::getrusage(RUSAGE_CHILDREN, &children);
  return 1024e-6 * static_cast<double>(own.ru_maxrss + children.ru_maxrss);  // the kernel counts in KiB
}

Result<std::vector<JobOutcome>> run_batch(const std::vector<Job>& jobs, const BatchOptions& options) {
  const std::vector<fs::path> folders = run_folders(jobs, options.out);
  if (const Result<void> checked = check_folders(jobs, folders); !checked) return checked.failure();
  StageGraph graph;
  const std::vector<WiredJob> wired = build_graph(graph, jobs);
  RunOptions run = options.run;
  if (const Result<void> checked = check_stop(graph, run.stop_after); !checked) return checked.failure();
  for (const WiredJob& job : wired)
    for (const NodeId id : job.wanted()) run.wanted.push_back(id);

  const RunOutcome outcome = run_graph(graph, run);

  std::vector<JobOutcome> results;
  std::vector<JobReport> finished;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const JobReport report = report_of(jobs[i], wired[i], graph, outcome);
    JobOutcome& result = results.emplace_back();
    result.name = jobs[i].header.name;
    result.run_folder = folders[i];
    result.failure = report.error;
    for (const StageRecord& record : report.stages) {
      for (const Warning& warning : record.outcome.warnings)
        result.warnings.push_back(record.node + ": " + warning.kind + ": " + warning.what);
      if (!record.timing.not_stored.empty())
        result.warnings.push_back(record.node + ": not_stored: " + record.timing.not_stored);
    }
    const auto is_cancelled = [&] { return run.cancellation && run.cancellation->is_cancelled(); };
    const Failure cancelled{FailureCode::cancelled, "cancelled",
                            "run it again: finished stages are taken from the store"};
    if (!result.failure && is_cancelled()) result.failure = cancelled;
    const fs::path failed_folder = folders[i].string() + ".failed";
    const auto facts = [&](const fs::path& folder) {
      return RunFacts{thread_count(run), outcome.total_s, peak_memory_mb(), folder};
    };
    if (result.failure) {
      if (result.failure->code != FailureCode::cancelled)
        leave_for_inspection(failed_folder, inspection_files(report, facts(failed_folder)), *result.failure);
      continue;
    }
    const std::vector<RunFile> files = run_files(report, facts(folders[i]));
    if (is_cancelled())
      result.failure = cancelled;
    else if (const Result<void> written = replace_run_folder(folders[i], files); !written)
      result.failure = written.failure();
    else {
      remove_run_folder(failed_folder);  // of an earlier run
      finished.push_back(report);
    }
  }
  if (finished.size() > 1) {  // one page for all, beside the first run folder
    const fs::path page = folders.front().parent_path() / "comparison.html";
    if (const Result<void> written = write_file_atomically(page, comparison_html(finished)); !written)
      results.front().warnings.push_back("comparison: not_written: " + written.failure().what);
  }
  return results;
}

}  // namespace strataflow
