#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "base/result.h"

namespace strataflow {

/// The first stage, in the order of the reports, whose digest (or name, version, status) differs between two run
/// folders, told to a person; nothing when all agree. Fails with unreadable_file or malformed_file.
Result<std::optional<std::string>> first_difference(const std::filesystem::path& run_a,
                                                    const std::filesystem::path& run_b);

}  // namespace strataflow
