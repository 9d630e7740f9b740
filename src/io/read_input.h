#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "model/input_data.h"

namespace strataflow {

/// One line of the table of formats: file endings are lower case, without the dot.
struct InputFormat {
  std::string_view ending;
  std::string_view description;
  Result<InputData> (*read)(std::string_view bytes, const std::string& file_name);
};

/// Every format read_input knows, in the order shown to a user.
std::span<const InputFormat> input_formats();

/// Reads any supported file, gzipped or not, .tar / .tar.gz / .tgz archives of such files (in archive order), and
/// native model files (.sfm).
/// The ending decides; content that starts like a GOCAD object is read as GOCAD whatever the ending.
/// Coordinates are the file's own (`local_origin` is zero), z up. Messages name the file without its folder.
/// Fails with: unreadable_file, malformed_file, unsupported.
Result<InputData> read_input(const std::filesystem::path& path);

/// Contents of the files that `path` includes (sections only), in the order met: with the file's own they are all that
/// read_input depends on. Those that cannot be read are left out.
std::vector<std::string> included_texts(const std::filesystem::path& path);

/// The same as read_input for bytes that are in memory (unpacked already); `file_name` gives the ending.
Result<InputData> read_input_bytes(std::string_view bytes, const std::string& file_name);

}  // namespace strataflow
