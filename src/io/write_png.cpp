#include "io/write_png.h"

#include <zlib.h>

#include <array>
#include <cstdlib>
#include <string>
#include <string_view>

namespace strataflow {

namespace {

void append_big_endian(std::uint32_t value, std::vector<std::byte>& bytes) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::byte>(value >> shift & 0xff));
}

/// Length, four-letter type, content, and the checksum of type and content.
void append_chunk(std::string_view type, std::span<const std::uint8_t> content, std::vector<std::byte>& png) {
  append_big_endian(static_cast<std::uint32_t>(content.size()), png);
  const std::size_t begin = png.size();
  for (const char c : type) png.push_back(static_cast<std::byte>(c));
  const auto* data = reinterpret_cast<const std::byte*>(content.data());
  png.insert(png.end(), data, data + content.size());
  const auto* checked = reinterpret_cast<const Bytef*>(png.data() + begin);
  append_big_endian(static_cast<std::uint32_t>(crc32_z(0, checked, png.size() - begin)), png);
}

/// Each row after the filter "up" or "sub" (difference to the pixel above or to the left), whichever leaves less.
std::vector<std::uint8_t> filtered_rows(std::size_t row_size, std::uint32_t height, std::span<const std::uint8_t> rgb) {
  constexpr std::uint8_t sub = 1, up = 2;
  std::vector<std::uint8_t> result((row_size + 1) * height);
  std::vector<std::uint8_t> left(row_size), above(row_size);
  for (std::uint32_t y = 0; y < height; ++y) {
    const std::uint8_t* row = rgb.data() + y * row_size;
    int left_sum = 0, above_sum = 0;
    for (std::size_t i = 0; i < row_size; ++i) {
      left[i] = static_cast<std::uint8_t>(row[i] - (i >= 3 ? row[i - 3] : 0));
      above[i] = static_cast<std::uint8_t>(row[i] - (y > 0 ? row[i - row_size] : 0));
      left_sum += std::abs(static_cast<std::int8_t>(left[i]));
      above_sum += std::abs(static_cast<std::int8_t>(above[i]));
    }
    std::uint8_t* out = result.data() + y * (row_size + 1);
    const bool takes_left = left_sum < above_sum;
    *out++ = takes_left ? sub : up;
    for (const std::uint8_t byte : takes_left ? left : above) *out++ = byte;
  }
  return result;
}

}  // namespace

Result<std::vector<std::byte>> encode_png(std::uint32_t width, std::uint32_t height,
                                          std::span<const std::uint8_t> rgb) {
  constexpr std::uint32_t largest = 0x7fffffff;
  if (width == 0 || height == 0 || width > largest || height > largest || rgb.size() / 3 / width != height ||
      rgb.size() % (std::size_t{3} * width) != 0)
    return Failure{FailureCode::invalid_input,
                   "an image of " + std::to_string(width) + " by " + std::to_string(height) + " pixels cannot hold " +
                       std::to_string(rgb.size()) + " bytes",
                   "give three bytes for each pixel"};
  const std::vector<std::uint8_t> rows = filtered_rows(std::size_t{3} * width, height, rgb);
  uLongf size = compressBound(static_cast<uLong>(rows.size()));
  std::vector<std::uint8_t> compressed(size);
  if (compress2(compressed.data(), &size, rows.data(), static_cast<uLong>(rows.size()), 6) != Z_OK || size > largest)
    return Failure{FailureCode::invalid_input, "the image is too large for one PNG chunk", "make the picture smaller"};
  compressed.resize(size);

  std::vector<std::byte> png;
  for (const int byte : {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a}) png.push_back(static_cast<std::byte>(byte));
  std::array<std::uint8_t, 13> header{};
  for (int i = 0; i < 4; ++i) {
    header[i] = static_cast<std::uint8_t>(width >> (24 - 8 * i));
    header[4 + i] = static_cast<std::uint8_t>(height >> (24 - 8 * i));
  }
  header[8] = 8;  // bits per channel
  header[9] = 2;  // red, green, blue
  append_chunk("IHDR", header, png);
  append_chunk("IDAT", compressed, png);
  append_chunk("IEND", {}, png);
  return png;
}

}  // namespace strataflow
