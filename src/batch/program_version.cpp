#include "batch/program_version.h"

#include <sstream>

namespace strataflow {

std::string program_version() { return STRATAFLOW_VERSION; }

std::vector<std::string> library_versions() {
  std::vector<std::string> libraries;
  std::istringstream text(STRATAFLOW_LIBRARIES);
  for (std::string library; std::getline(text, library, ',');) libraries.push_back(library);
  return libraries;
}

}  // namespace strataflow
