#include "io/bytes/input_file.h"

#include <zlib.h>

#include <algorithm>

#include "base/atomic_file.h"

namespace strataflow {

bool is_gzip(std::string_view bytes) { return bytes.size() >= 2 && bytes[0] == '\x1f' && bytes[1] == '\x8b'; }

Result<std::string> unpack_gzip(std::string_view bytes, const std::string& file_name, std::size_t maximum_bytes) {
  static constexpr std::size_t largest_step = std::size_t{1} << 30;  // zlib counts with 32 bits
  const auto damaged = [&](const std::string& why) {
    return Failure{FailureCode::malformed_file, file_name + ": gzip: " + why, "fetch or compress the file again"};
  };
  z_stream stream{};
  if (inflateInit2(&stream, 16 + MAX_WBITS) != Z_OK) return damaged("zlib does not start");
  std::string text;
  text.resize(std::min(maximum_bytes, std::max<std::size_t>(4096, 4 * bytes.size())));
  std::size_t used_in = 0;
  std::size_t used_out = 0;
  int state = Z_OK;
  bool inside_member = true;
  while (true) {
    if (state == Z_STREAM_END) {  // further members may follow; other trailing bytes are padding
      inside_member = is_gzip(bytes.substr(used_in));
      if (!inside_member || inflateReset(&stream) != Z_OK) break;
    }
    if (used_out == text.size()) {
      if (text.size() >= maximum_bytes) {
        inflateEnd(&stream);
        return damaged("unpacks to more than " + std::to_string(maximum_bytes) + " bytes");
      }
      text.resize(std::min(maximum_bytes, 2 * text.size()));
    }
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + used_in));  // zlib reads only
    stream.avail_in = static_cast<uInt>(std::min(bytes.size() - used_in, largest_step));
    stream.next_out = reinterpret_cast<Bytef*>(text.data() + used_out);
    stream.avail_out = static_cast<uInt>(std::min(text.size() - used_out, largest_step));
    const uInt given_in = stream.avail_in;
    const uInt given_out = stream.avail_out;
    state = inflate(&stream, Z_NO_FLUSH);
    used_in += given_in - stream.avail_in;
    used_out += given_out - stream.avail_out;
    if (state == Z_STREAM_END || state == Z_OK) continue;
    if (state == Z_BUF_ERROR && stream.avail_out == 0) continue;  // only wants more room
    break;
  }
  const bool is_whole = state == Z_STREAM_END;
  const bool is_short = state == Z_OK || state == Z_BUF_ERROR;
  const std::string message = stream.msg ? stream.msg : "damaged";
  inflateEnd(&stream);
  if (!is_whole) return damaged(is_short ? "truncated" : message);
  text.resize(used_out);
  return text;
}

Result<std::string> read_input_text(const std::filesystem::path& path) {
  Result<std::string> content = read_file(path);
  if (!content || !is_gzip(*content)) return content;
  return unpack_gzip(*content, path.filename().string());
}

}  // namespace strataflow
