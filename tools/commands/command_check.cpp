#include <algorithm>

#include "batch/check_model.h"
#include "batch/convert.h"
#include "batch/report/report_json.h"
#include "commands.h"
#include "graph/parallel/schedule.h"
#include "terminal.h"

namespace strataflow {

namespace {

/// Writes the model as it was built, and says what that mended. Violations that only the file had are then gone.
int repair(const CheckedModel& checked, const std::filesystem::path& out) {
  if (const Result<void> written = write_model(out, checked.built.model); !written)
    return report_failure(written.failure());
  std::string text = "wrote " + out.string() + "\n";
  bool is_valid = true;
  std::size_t changes = 0;
  for (const Violation& violation : checked.validity.violations) {
    if (violation.is_mended) {
      ++changes;
      text += "changed: " + violation.kind + ": " + violation.what + "\n";
    } else if (violation.severity == Violation::Severity::error) {
      is_valid = false;
      text += "not repaired: " + violation.kind + ": " + violation.what + "\n  what to do: " + violation.remedy + "\n";
    }
  }
  if (changes == 0) text += "nothing had to be changed\n";
  return std::max(print_result(text), is_valid ? 0 : 1);
}

}  // namespace

int check_command(const CheckArguments& arguments) {
  // An ending that cannot be written is known before any work.
  if (arguments.repair && ending_of(*arguments.repair) != ".sfm")
    if (const Result<std::string> tried = encode_model({}, ending_of(*arguments.repair), ""); !tried)
      return report_failure({FailureCode::invalid_usage, "--repair: " + tried.failure().what, tried.failure().remedy});
  const ScheduleScope threads(ScheduleKind::threads);
  const Result<CheckedModel> checked = check_model(arguments.files);
  if (!checked) return report_failure(checked.failure());
  for (const Warning& warning : checked->warnings) report_warning(warning.kind + ": " + warning.what);
  int exit_code = 0;
  if (arguments.json)
    exit_code = print_result(model_json(checked->built, checked->validity));
  else if (!arguments.repair)
    exit_code = print_result(model_text(*checked));
  if (arguments.repair) return std::max(exit_code, repair(*checked, *arguments.repair));
  return std::max(exit_code, checked->validity.is_valid() ? 0 : 1);
}

}  // namespace strataflow
