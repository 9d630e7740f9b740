#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/result.h"

namespace strataflow {

/// Largest file we take, unpacked: a small gzip file can name any amount of memory.
inline constexpr std::size_t maximum_input_bytes = std::size_t{8} << 30;

/// Reads a whole file and unpacks it when its first bytes say gzip, whatever its name is.
/// Fails with: unreadable_file (missing, a folder, no permission), malformed_file (damaged gzip, too large).
Result<std::string> read_input_text(const std::filesystem::path& path);

/// The content of gzip bytes, all members one after the other. Fails with malformed_file.
Result<std::string> unpack_gzip(std::string_view bytes, const std::string& file_name,
                                std::size_t maximum_bytes = maximum_input_bytes);

/// True when the bytes start like a gzip file.
bool is_gzip(std::string_view bytes);

}  // namespace strataflow
