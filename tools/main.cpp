#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <exception>
#include <new>

#include "batch/options/closest_word.h"
#include "batch/program_version.h"
#include "commands/commands.h"
#include "commands/terminal.h"

namespace {

using namespace strataflow;

CancellationToken cancellation;

/// The first signal asks the run to stop; a second one ends it at once.
void ask_to_stop(int signal) {
  cancellation.cancel();
  std::signal(signal, SIG_DFL);
}

void add_run(CLI::App& app, RunArguments& arguments) {
  CLI::App* command = app.add_subcommand("run", "Run batch jobs");
  command->add_option("JOB", arguments.jobs, "Job files (TOML)")->required();
  command->add_option("--out", arguments.out, "Run folder (several jobs: the folder of their run folders)");
  command->add_option("--threads", arguments.threads, "Number of threads; 0: all cores")->check(CLI::Range(0, 1024));
  command->add_option("--set", arguments.settings, "SECTION.KEY=VALUE: overrides the job file")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--stop-after", arguments.stop_after, "Run this stage and what it needs, nothing more");
  CLI::Option* cache =
      command->add_option("--cache", arguments.cache, "Folder of the stage store (default: ~/.cache/strataflow)");
  command->add_flag("--no-cache", arguments.no_cache, "Neither read nor write the stage store")->excludes(cache);
  command->add_option("--executor", arguments.executor, "tbb, serial, or shuffled:SEED");
  command->add_option("--progress", arguments.progress, "auto, plain or none")
      ->check(CLI::IsMember({"auto", "plain", "none"}));
  command->add_flag("--quiet", arguments.quiet, "Only failures are shown");
}

void add_check(CLI::App& app, CheckArguments& arguments) {
  CLI::App* command = app.add_subcommand("check", "Build the model of one or more files and check its validity");
  command->add_option("MODEL", arguments.files, "Files of one model")->required();
  command->add_flag("--json", arguments.json, "Print the model block of report.json");
  command->add_option("--repair", arguments.repair, "Write the repaired model here, and say what was changed");
}

void add_graph(CLI::App& app, GraphArguments& arguments) {
  CLI::App* command = app.add_subcommand("graph", "Print the dataflow graph of a job without running it");
  command->add_option("JOB", arguments.job, "Job file (TOML)")->required();
  command->add_option("--format", arguments.format, "dot, mermaid or json")
      ->check(CLI::IsMember({"dot", "mermaid", "json"}));
  command->add_option("--set", arguments.settings, "SECTION.KEY=VALUE: overrides the job file")
      ->take_all()
      ->allow_extra_args(false);
}

void add_stages(CLI::App& app, StagesArguments& arguments) {
  CLI::App* command = app.add_subcommand("stages", "List every stage and its options");
  CLI::Option* json = command->add_flag("--json", arguments.json, "As JSON");
  command->add_flag("--markdown", arguments.markdown, "As docs/stages.md")->excludes(json);
}

void add_quality(CLI::App& app, QualityArguments& arguments) {
  CLI::App* command = app.add_subcommand("quality", "Measure meshes and check that they are valid");
  command->add_option("MESH", arguments.files, "Mesh files")->required();
  command->add_flag("--json", arguments.json, "As JSON");
  command->add_flag("--patch-test", arguments.patch_test, "Also solve for linear fields on valid cells: they must come out exactly");
}

void add_diff(CLI::App& app, DiffArguments& arguments) {
  CLI::App* command = app.add_subcommand("diff", "Name the first stage in which two runs differ");
  command->add_option("RUN_A", arguments.run_a, "Run folder")->required();
  command->add_option("RUN_B", arguments.run_b, "Run folder")->required();
}

void add_convert(CLI::App& app, ConvertArguments& arguments) {
  CLI::App* command = app.add_subcommand("convert", "Convert between file formats, by their endings");
  command->add_option("IN", arguments.in, "File to read")->required();
  command->add_option("OUT", arguments.out, "File to write")->required();
}

void add_generate(CLI::App& app, GenerateArguments& arguments) {
  CLI::App* command = app.add_subcommand("generate", "Make a reference model");
  command->add_option("NAME", arguments.name, "A1 … A6, B, C, D")->required();
  command->add_option("--out", arguments.out, "File to write (default: NAME.ml, raw: NAME.ts)");
  command->add_option("--resolution", arguments.resolution_m, "Length of the triangles' edges, m");
  command->add_option("--raw", arguments.raw_ratio, "Unsealed: surfaces stop short by this share of their extent");
}

std::string version_text() {
  std::string text = "strataflow " + program_version() + "\n";
  for (const std::string& library : library_versions()) text += "  " + library + "\n";
  return text;
}

int run_program(int argc, char** argv) {
  CLI::App app("Meshes geological structural models in batch: the same bits on any number of threads");
  app.require_subcommand(1);
  // Not CLI11's own version flag: that one throws its text at the first line only.
  app.add_flag_callback(
      "--version", [] { throw CLI::CallForVersion(version_text(), 0); }, "Print our version and that of every library");
  RunArguments run;
  CheckArguments check;
  GraphArguments graph;
  StagesArguments stages;
  QualityArguments quality;
  DiffArguments diff;
  ConvertArguments convert;
  GenerateArguments generate;
  add_run(app, run);
  add_check(app, check);
  add_graph(app, graph);
  add_stages(app, stages);
  add_quality(app, quality);
  add_diff(app, diff);
  add_convert(app, convert);
  add_generate(app, generate);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    const std::string_view first = argc > 1 ? argv[1] : "";
    std::vector<std::string_view> commands;
    for (const CLI::App* command : app.get_subcommands({})) commands.push_back(command->get_name());
    if (!first.empty() && first[0] != '-' && std::find(commands.begin(), commands.end(), first) == commands.end())
      return report_failure(
          {FailureCode::invalid_usage, "unknown command '" + std::string(first) + "'", suggestion(first, commands)});
    // Help and version are results; everything else is wrong usage.
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (app.got_subcommand("run")) {  // the other commands do not look at the token: a signal ends them at once
    std::signal(SIGINT, ask_to_stop);
    std::signal(SIGTERM, ask_to_stop);
    return run_command(run, cancellation);
  }
  if (app.got_subcommand("check")) return check_command(check);
  if (app.got_subcommand("graph")) return graph_command(graph);
  if (app.got_subcommand("stages")) return stages_command(stages);
  if (app.got_subcommand("quality")) return quality_command(quality);
  if (app.got_subcommand("diff")) return diff_command(diff);
  if (app.got_subcommand("convert")) return convert_command(convert);
  return generate_command(generate);
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);  // a reader that goes away is no reason to die halfway
  try {
    return run_program(argc, argv);
  } catch (const std::bad_alloc&) {
    return strataflow::report_failure({strataflow::FailureCode::invalid_input, "not enough memory for this input",
                                       "free memory, or coarsen the model"});
  } catch (const std::exception& error) {
    return strataflow::report_failure({strataflow::FailureCode::internal_error,
                                       std::string("internal error: ") + error.what(),
                                       "this is our bug: please report it with the command line and the input"});
  }
}
