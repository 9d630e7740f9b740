#pragma once
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "base/result.h"

namespace strataflow {

/// Reads a whole regular file. Fails with unreadable_file for a missing file, no permission, and whatever has no end to
/// trust: a folder, a pipe, a device.
Result<std::string> read_file(const std::filesystem::path& file);

/// Writes `content` to a neighbour of `file` and renames it: readers see the old file or the whole new one.
/// Missing parent folders are made. Fails with write_failed.
Result<void> write_file_atomically(const std::filesystem::path& file, std::string_view content);
Result<void> write_file_atomically(const std::filesystem::path& file, std::span<const std::byte> content);

/// A name beside `path` that no other process and no other call of this one uses.
std::filesystem::path scratch_name_beside(const std::filesystem::path& path);

}  // namespace strataflow
