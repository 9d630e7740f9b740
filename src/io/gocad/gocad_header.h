#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "base/warning.h"
#include "io/text/text_scanner.h"
#include "model/geology.h"

namespace strataflow {

/// One of the properties an object declares for its vertices.
struct GocadProperty {
  std::string name;
  std::string unit;
  std::uint32_t width = 1;
  double no_data = std::numeric_limits<double>::quiet_NaN();
};

/// What a GOCAD object says about itself before its geometry.
struct GocadHeader {
  std::string name;
  std::string type;       ///< GEOLOGICAL_TYPE, lower case; may be empty
  bool is_depth = false;  ///< ZPOSITIVE Depth
  std::vector<GocadProperty> properties;
};

/// Takes the scanner's line, whose first word `word` was read: what concerns the header is kept, blocks in braces are
/// read to their end, all else is ignored. Fails with malformed_file for an unclosed block or impossible ESIZES.
Result<void> read_gocad_header_line(TextScanner& scanner, std::string_view word, GocadHeader& header,
                                    std::vector<Warning>& warnings);

/// The role a GEOLOGICAL_TYPE or a kind of the TFACE table stands for; unknown for other words.
Role role_from_gocad(std::string_view kind);
/// The kind to write for a role.
std::string_view gocad_kind_of(Role role);

}  // namespace strataflow
