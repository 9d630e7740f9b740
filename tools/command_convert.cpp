#include "base/atomic_file.h"
#include "batch/check_model.h"
#include "batch/convert.h"
#include "commands.h"
#include "graph/parallel/schedule.h"
#include "terminal.h"

namespace strataflow {

int convert_command(const ConvertArguments& arguments) {
  if (arguments.out.extension().empty() || writable_endings().find(ending_of(arguments.out)) == std::string::npos)
    return report_failure(
        {FailureCode::invalid_usage, "cannot write " + arguments.out.string(), "endings: " + writable_endings()});
  const ScheduleScope threads(ScheduleKind::threads);
  const Result<InputData> input = read_inputs({arguments.in});
  if (!input) return report_failure(input.failure());
  for (const Warning& warning : input->warnings) report_warning(warning.kind + ": " + warning.what);
  const Result<std::string> content = encode_input(*input, ending_of(arguments.out), arguments.out.stem().string());
  if (!content) return report_failure(content.failure());
  if (const Result<void> written = write_file_atomically(arguments.out, *content); !written)
    return report_failure(written.failure());
  return 0;
}

}  // namespace strataflow
