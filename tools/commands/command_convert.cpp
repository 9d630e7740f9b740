#include "batch/check_model.h"
#include "batch/convert.h"
#include "commands.h"
#include "graph/parallel/schedule.h"
#include "terminal.h"

namespace strataflow {

int convert_command(const ConvertArguments& arguments) {
  if (const Result<void> able = can_write(arguments.out); !able) return report_failure(able.failure());
  const ScheduleScope threads(ScheduleKind::threads);
  const Result<InputData> input = read_inputs({arguments.in});
  if (!input) return report_failure(input.failure());
  for (const Warning& warning : input->warnings) report_warning(warning.kind + ": " + warning.what);
  const Result<void> written = write_input(arguments.out, *input, arguments.out.stem().string());
  if (!written) {
    Failure failure = written.failure();
    failure.what = "converting " + arguments.in.string() + ": " + failure.what;
    return report_failure(failure);
  }
  if (const std::string lost = left_out(*input, ending_of(arguments.out)); !lost.empty())
    report_warning("left_out: " + ending_of(arguments.out) + " does not hold " + lost + " of " + arguments.in.string());
  return 0;
}

}  // namespace strataflow
