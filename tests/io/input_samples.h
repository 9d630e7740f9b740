#pragma once
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/atomic_file.h"

namespace strataflow::support {

/// A file of tests/data, which the repository holds.
inline std::filesystem::path own_sample(const std::string& name) {
  return std::filesystem::path(STRATAFLOW_SOURCE_DIR) / "tests/data" / name;
}

inline std::string text_of(const std::filesystem::path& file) {
  const Result<std::string> text = read_file(file);
  EXPECT_TRUE(text) << file;
  return text ? *text : std::string();
}

/// The text as a gzip file.
inline std::string gzipped(const std::string& text) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(deflateBound(&stream, text.size()) + 64, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

/// The folder of real models, which is not part of the repository.
inline std::filesystem::path shared_data() {
  const char* folder = std::getenv("STRATAFLOW_DATA");
  return folder ? std::filesystem::path(folder) : std::filesystem::path(STRATAFLOW_SOURCE_DIR) / "../shared/data";
}

}  // namespace strataflow::support

/// Skips the test when the real models are not there.
#define STRATAFLOW_NEEDS_SHARED_DATA()                              \
  if (!std::filesystem::exists(strataflow::support::shared_data())) \
  GTEST_SKIP() << "no real models at " << strataflow::support::shared_data() << " (set STRATAFLOW_DATA)"
