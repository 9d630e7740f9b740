#include <algorithm>

#include "batch/diff_runs.h"
#include "commands.h"
#include "terminal.h"

namespace strataflow {

int diff_command(const DiffArguments& arguments) {
  const Result<std::optional<std::string>> difference = first_difference(arguments.run_a, arguments.run_b);
  if (!difference) return report_failure(difference.failure());
  return std::max(print_result(difference->value_or("same digests in every stage") + "\n"), *difference ? 1 : 0);
}

}  // namespace strataflow
