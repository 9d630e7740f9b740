#pragma once
#include <string>
#include <vector>

#include "base/failure.h"
#include "batch/options/job_value.h"

namespace strataflow {

/// One combination of a [sweep]: the job file's values with the swept ones in place.
struct SweepMember {
  JobValue root;            ///< without its "sweep"
  std::string name_suffix;  ///< "" without a sweep, otherwise "_remesh.sites=5000_…": unique among the members
};

/// Every combination of the values in [sweep] ("section.key" = [value, …]), the last key (in the order of their bytes)
/// varying fastest. Adds to `problems` what is not a list of values of a section's key.
std::vector<SweepMember> expand_sweep(const JobValue& root, std::vector<Failure>& problems);

}  // namespace strataflow
