#include "batch/convert.h"
#include "commands.h"
#include "graph/parallel/schedule.h"
#include "kernels/reference_models/generate_reference_model.h"
#include "terminal.h"

namespace strataflow {

int generate_command(const GenerateArguments& arguments) {
  // Raw surfaces do not bound regions: by default they are written as surfaces, sealed ones as a model.
  const std::filesystem::path out = arguments.out.value_or(arguments.name + (arguments.raw_ratio ? ".ts" : ".ml"));
  if (const Result<void> able = can_write(out); !able) return report_failure(able.failure());
  const ScheduleScope threads(ScheduleKind::threads);
  Result<TriangleSoup> surfaces =
      generate_reference_model(arguments.name, {arguments.resolution_m, arguments.raw_ratio});
  if (!surfaces) return report_failure(surfaces.failure());
  InputData data;
  data.surfaces = *std::move(surfaces);
  if (const Result<void> written = write_input(out, data, arguments.name); !written)
    return report_failure(written.failure());
  return print_result(out.string() + "\n");
}

}  // namespace strataflow
