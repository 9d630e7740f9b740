#include "base/atomic_file.h"
#include "batch/convert.h"
#include "commands.h"
#include "graph/parallel/schedule.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "terminal.h"

namespace strataflow {

int generate_command(const GenerateArguments& arguments) {
  // Raw surfaces do not bound regions: by default they are written as surfaces, sealed ones as a model.
  const std::filesystem::path out = arguments.out.value_or(arguments.name + (arguments.raw_ratio ? ".ts" : ".ml"));
  if (out.extension().empty() || writable_endings().find(ending_of(out)) == std::string::npos)
    return report_failure(
        {FailureCode::invalid_usage, "cannot write " + out.string(), "endings: " + writable_endings()});
  const ScheduleScope threads(ScheduleKind::threads);
  Result<TriangleSoup> surfaces =
      generate_reference_model(arguments.name, {arguments.resolution_m, arguments.raw_ratio});
  if (!surfaces) return report_failure(surfaces.failure());
  InputData data;
  data.surfaces = *std::move(surfaces);
  const Result<std::string> content = encode_input(data, ending_of(out), arguments.name);
  if (!content) return report_failure(content.failure());
  if (const Result<void> written = write_file_atomically(out, *content); !written)
    return report_failure(written.failure());
  print_result(out.string() + "\n");
  return 0;
}

}  // namespace strataflow
