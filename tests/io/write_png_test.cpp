#include "io/write_png.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>
#include <string>

namespace strataflow {
namespace {

std::uint32_t big_endian(const std::uint8_t* bytes) {
  return static_cast<std::uint32_t>(bytes[0]) << 24 | bytes[1] << 16 | bytes[2] << 8 | bytes[3];
}

/// Reads our PNG back as the standard says: chunks with checksums, zlib, one filter byte a row.
std::vector<std::uint8_t> decoded(const std::vector<std::byte>& png, std::uint32_t& width, std::uint32_t& height) {
  const auto* data = reinterpret_cast<const std::uint8_t*>(png.data());
  EXPECT_EQ(std::memcmp(data, "\x89PNG\r\n\x1a\n", 8), 0);
  std::vector<std::uint8_t> packed;
  std::string order;
  for (std::size_t at = 8; at + 12 <= png.size();) {
    const std::uint32_t size = big_endian(data + at);
    const std::string type(reinterpret_cast<const char*>(data + at + 4), 4);
    EXPECT_EQ(big_endian(data + at + 8 + size), crc32(0, data + at + 4, size + 4)) << type;
    order += type;
    if (type == "IHDR") {
      width = big_endian(data + at + 8);
      height = big_endian(data + at + 12);
      EXPECT_EQ(data[at + 16], 8);
      EXPECT_EQ(data[at + 17], 2);
    }
    if (type == "IDAT") packed.insert(packed.end(), data + at + 8, data + at + 8 + size);
    at += size + 12;
  }
  EXPECT_EQ(order, "IHDRIDATIEND");
  const std::size_t row = 3 * width;
  std::vector<std::uint8_t> rows((row + 1) * height), rgb(row * height);
  uLongf size = rows.size();
  EXPECT_EQ(uncompress(rows.data(), &size, packed.data(), packed.size()), Z_OK);
  EXPECT_EQ(size, rows.size());
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::size_t i = 0; i < row; ++i) {
      const std::uint8_t filter = rows[y * (row + 1)];
      std::uint8_t before = 0;
      if (filter == 1 && i >= 3) before = rgb[y * row + i - 3];
      if (filter == 2 && y > 0) before = rgb[(y - 1) * row + i];
      rgb[y * row + i] = static_cast<std::uint8_t>(rows[y * (row + 1) + 1 + i] + before);
    }
  return rgb;
}

TEST(EncodePng, what_a_png_reader_sees_is_the_image) {
  constexpr std::uint32_t width = 37, height = 23;
  std::vector<std::uint8_t> rgb;
  for (std::uint32_t i = 0; i < width * height * 3; ++i)  // flat areas, ramps and noise: both filters are used
    rgb.push_back(static_cast<std::uint8_t>(i < 900 ? 255 : i < 1800 ? i / 3 : i * i * 7 >> 3));
  const auto png = encode_png(width, height, rgb);
  ASSERT_TRUE(png);
  std::uint32_t seen_width = 0, seen_height = 0;
  EXPECT_EQ(decoded(*png, seen_width, seen_height), rgb);
  EXPECT_EQ(seen_width, width);
  EXPECT_EQ(seen_height, height);
}

TEST(EncodePng, sizes_that_do_not_fit_the_bytes_are_refused) {
  const std::vector<std::uint8_t> rgb(12);
  EXPECT_TRUE(encode_png(2, 2, rgb));
  for (const auto& [width, height] : {std::pair{2u, 3u}, {0u, 4u}, {4u, 0u}, {5u, 1u}, {0xffffffffu, 0xffffffffu}}) {
    const auto png = encode_png(width, height, rgb);
    ASSERT_FALSE(png);
    EXPECT_EQ(png.failure().code, FailureCode::invalid_input);
  }
}

}  // namespace
}  // namespace strataflow
