#pragma once
#include <cstdint>
#include <vector>

namespace strataflow {

struct Colour {
  std::uint8_t red = 0, green = 0, blue = 0;
  static constexpr bool is_flat = true;
  friend constexpr bool operator==(const Colour&, const Colour&) = default;
};

/// Pixels row by row from the top left.
struct Image {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 · width · height

  Colour at(std::uint32_t x, std::uint32_t y) const {
    const std::uint8_t* pixel = &rgb[3 * (static_cast<std::size_t>(y) * width + x)];
    return {pixel[0], pixel[1], pixel[2]};
  }
  template <class A>
  void archive(A& a) {
    a(width, height, rgb);
  }
};

}  // namespace strataflow
