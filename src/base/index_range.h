#pragma once
#include <cstdint>
#include <string>

#include "base/id.h"
#include "base/result.h"

namespace strataflow {

/// Indices have 32 bits and keep `no_index` free. Fails with unsupported when `count` things ("points") need more;
/// `owner` is what holds them: a file, a mesh.
inline Result<void> check_index_range(std::uint64_t count, const std::string& things, const std::string& owner) {
  if (count < no_index) return {};
  return Failure{FailureCode::unsupported,
                 owner + ": " + std::to_string(count) + " " + things + ", more than " + std::to_string(no_index - 1),
                 "coarsen it, or split it into several models"};
}

}  // namespace strataflow
