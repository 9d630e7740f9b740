#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/internal_error.h"
#include "io/bytes/input_file.h"
#include "io/read_input.h"

/// Whatever the bytes: gzip and tar give a value or a named failure, and never take more room than they may.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace strataflow;
  static constexpr std::size_t limit = std::size_t{1} << 20;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  std::string unpacked(bytes);
  if (is_gzip(bytes)) {
    Result<std::string> text = unpack_gzip(bytes, "fuzz.tar.gz", limit);
    if (!text) return 0;
    STRATAFLOW_ASSERT(text->size() <= limit, "unpacked past the limit");
    unpacked = std::move(*text);
  }
  const Result<InputData> input = read_input_bytes(unpacked, "fuzz.tar");
  if (!input) STRATAFLOW_ASSERT(!input.failure().what.empty(), "a failure without words");
  return 0;
}
