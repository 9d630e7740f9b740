#include "base/internal_error.h"

#include <cstring>

namespace strataflow {

void raise_internal_error(const char* condition, const char* file, int line, const std::string& message) {
  const char* inside = std::strstr(file, "src/");
  throw InternalError(std::string(inside ? inside : file) + ":" + std::to_string(line) + ": " + message + " [" +
                      condition + "]");
}

}  // namespace strataflow
