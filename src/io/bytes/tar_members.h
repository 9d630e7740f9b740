#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace strataflow {

/// A regular file inside a tar archive; `content` points into the archive's bytes.
struct TarMember {
  std::string name;
  std::string_view content;
};

/// The regular files of a tar archive (ustar, GNU and pax long names), in archive order. Fails with malformed_file.
Result<std::vector<TarMember>> tar_members(std::string_view bytes, const std::string& file_name);

}  // namespace strataflow
