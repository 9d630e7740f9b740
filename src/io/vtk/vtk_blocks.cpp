#include "io/vtk/vtk_blocks.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <vector>

#include "io/bytes/byte_order.h"

namespace strataflow {

namespace {
constexpr std::uint64_t max_inflation = 1032;  // deflate says at most 258 bytes with two bits
constexpr std::uint64_t block_size = std::uint64_t{1} << 20;
constexpr int compression_level = 6;  // part of the result: changing it changes every written file

constexpr std::array<std::int8_t, 256> base64_values = [] {
  std::array<std::int8_t, 256> values{};
  for (auto& value : values) value = -1;
  const std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (int i = 0; i < 64; ++i)
    values[static_cast<unsigned char>(letters[static_cast<std::size_t>(i)])] = static_cast<std::int8_t>(i);
  return values;
}();

/// Takes bytes one after the other from raw data or from base64, whose padding may stand between header and data.
class ByteSource {
 public:
  ByteSource(std::string_view encoded, bool is_base64) : encoded_(encoded), is_base64_(is_base64) {}

  std::uint64_t bytes_left_at_most() const {
    const std::uint64_t left = encoded_.size() - place_;
    return is_base64_ ? left / 4 * 3 + 3 + pending_.size() : left;
  }

  /// False when fewer than `count` bytes are left.
  bool take(std::uint64_t count, std::string& bytes) {
    bytes.clear();
    if (count > bytes_left_at_most()) return false;
    if (!is_base64_) {
      bytes.assign(encoded_.substr(place_, count));
      place_ += count;
      return true;
    }
    bytes.reserve(count + 3);
    bytes.swap(pending_);
    bytes.reserve(count + 3);
    while (bytes.size() < count)
      if (!take_quad(bytes)) return false;
    pending_.assign(bytes, count);
    bytes.resize(count);
    return true;
  }

 private:
  bool take_quad(std::string& bytes) {
    std::uint32_t bits = 0;
    int letters = 0, padding = 0;
    while (letters + padding < 4) {
      if (place_ == encoded_.size()) return false;
      const char letter = encoded_[place_++];
      if (letter == ' ' || letter == '\n' || letter == '\r' || letter == '\t') continue;
      if (letter == '=') {
        ++padding;
        bits <<= 6;
        continue;
      }
      const std::int8_t value = base64_values[static_cast<unsigned char>(letter)];
      if (value < 0 || padding > 0) return false;
      bits = bits << 6 | static_cast<std::uint32_t>(value);
      ++letters;
    }
    if (letters < 2) return false;
    for (int i = 0; i < letters - 1; ++i) bytes.push_back(static_cast<char>(bits >> (16 - 8 * i) & 0xff));
    return true;
  }

  std::string_view encoded_;
  bool is_base64_;
  std::size_t place_ = 0;
  std::string pending_;  // bytes of the last quad not yet asked for
};
}  // namespace

Result<std::string> unpack_vtk_array(std::string_view encoded, bool is_base64, const VtkPacking& packing,
                                     const std::string& name) {
  const auto malformed = [&](const std::string& what) {
    return Failure{FailureCode::malformed_file, name + ": " + what, "write the file again; it is damaged or cut short"};
  };
  ByteSource source(encoded, is_base64);
  const std::uint64_t header_item = packing.has_64_bit_headers ? 8 : 4;
  const auto header_value = [&](const std::string& bytes, std::size_t i) {
    return packing.has_64_bit_headers ? load_number<std::uint64_t>(bytes.data() + 8 * i, packing.is_big_endian)
                                      : load_number<std::uint32_t>(bytes.data() + 4 * i, packing.is_big_endian);
  };
  std::string bytes;
  if (!source.take(header_item, bytes)) return malformed("the array's header is cut short");
  const std::uint64_t first = header_value(bytes, 0);
  if (!packing.is_compressed) {
    if (!source.take(first, bytes))
      return malformed("says it holds " + std::to_string(first) + " bytes, more than are there");
    return bytes;
  }

  const std::uint64_t block_count = first;
  if (block_count > source.bytes_left_at_most() / header_item)
    return malformed("says it holds " + std::to_string(block_count) + " blocks, more than fit");
  if (!source.take(header_item * (2 + block_count), bytes)) return malformed("the array's header is cut short");
  const std::uint64_t full_size = header_value(bytes, 0), last_size = header_value(bytes, 1);
  std::vector<std::uint64_t> packed_sizes(block_count);
  for (std::size_t b = 0; b < block_count; ++b) packed_sizes[b] = header_value(bytes, 2 + b);

  std::string result, packed;
  for (std::size_t b = 0; b < block_count; ++b) {
    const std::uint64_t size = b + 1 == block_count && last_size != 0 ? last_size : full_size;
    if (!source.take(packed_sizes[b], packed))
      return malformed("compressed block " + std::to_string(b + 1) + " is cut short");
    if (size > max_inflation * packed.size())
      return malformed("compressed block " + std::to_string(b + 1) + " claims an impossible size of " +
                       std::to_string(size) + " bytes");
    const std::size_t begin = result.size();
    result.resize(begin + size);
    uLongf got = static_cast<uLongf>(size);
    const int status = ::uncompress(reinterpret_cast<Bytef*>(result.data() + begin), &got,
                                    reinterpret_cast<const Bytef*>(packed.data()), static_cast<uLong>(packed.size()));
    if (status != Z_OK || got != size) return malformed("compressed block " + std::to_string(b + 1) + " is damaged");
  }
  return result;
}

std::string pack_vtk_array(std::string_view bytes) {
  const std::uint64_t block_count = (bytes.size() + block_size - 1) / block_size;
  std::string header, blocks, packed;
  store_number<std::uint64_t>(header, block_count);
  store_number<std::uint64_t>(header, block_size);
  store_number<std::uint64_t>(header, bytes.size() % block_size);  // 0: the last block is full
  for (std::uint64_t begin = 0; begin < bytes.size(); begin += block_size) {
    const std::string_view block = bytes.substr(begin, block_size);
    uLongf size = ::compressBound(static_cast<uLong>(block.size()));
    packed.resize(size);
    const int status =
        ::compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(block.data()),
                    static_cast<uLong>(block.size()), compression_level);
    STRATAFLOW_ASSERT(status == Z_OK, "zlib refused a block within its own bound");
    store_number<std::uint64_t>(header, size);
    blocks.append(packed, 0, size);
  }
  return header + blocks;
}

}  // namespace strataflow
