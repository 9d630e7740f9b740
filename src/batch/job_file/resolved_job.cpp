#include "batch/job_file/resolved_job.h"

#include "base/option_field.h"

namespace strataflow {

namespace {

/// The way from the run folder to a file. Folders are followed through links, the file's own name is kept: it is part
/// of what the stage `read` is keyed by.
std::string relative_input(const std::filesystem::path& file, const std::filesystem::path& run_folder) {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::proximate(file.parent_path(), run_folder, error);
  return (error ? file : (folder / file.filename()).lexically_normal()).generic_string();
}

}  // namespace

std::string resolved_job_text(const Job& job, const std::filesystem::path& run_folder) {
  std::string text = "[job]\n" + printed_options(job.header);
  for (JobInput input : job.inputs) {
    if (input.file) input.file = relative_input(job.input_path(input), run_folder);
    text += "\n[[input]]\n" + printed_options(input);
  }
  text += "\n[output]\n" + printed_options(job.output);
  Job copy = job;  // sections are visited for reading and writing alike
  copy.visit_sections([&](std::string_view name, auto& options) {
    const std::string lines = printed_options(options);
    if (!lines.empty()) text += "\n[" + std::string(name) + "]\n" + lines;
  });
  return text;
}

}  // namespace strataflow
