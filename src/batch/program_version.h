#pragma once
#include <string>
#include <vector>

namespace strataflow {

/// "0.1.0"
std::string program_version();

/// "oneTBB 2021.8.0", … : every library inside, as found when it was built.
std::vector<std::string> library_versions();

}  // namespace strataflow
