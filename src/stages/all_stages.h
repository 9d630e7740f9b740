#pragma once
#include <string>
#include <vector>

#include "stages/stage_description.h"

namespace strataflow {

/// Every stage there is, in the order a job meets them. A new stage is one line in all_stages.cpp.
std::vector<StageDescription> all_stages();

/// docs/stages.md.
std::string stages_as_markdown();

}  // namespace strataflow
