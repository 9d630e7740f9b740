#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"

namespace strataflow {

/// A PNG file (8-bit RGB, not interlaced) of `height` rows of `width` pixels from the top left.
/// Fails with invalid_input unless rgb has 3 · width · height bytes and both sizes are 1 … 2^31 − 1.
Result<std::vector<std::byte>> encode_png(std::uint32_t width, std::uint32_t height, std::span<const std::uint8_t> rgb);

}  // namespace strataflow
