#pragma once
#include <array>
#include <cstdint>
#include <vector>

namespace strataflow {

/// Rectangles side by side in a box, with an empty row or column between any two.
struct Packing {
  std::array<std::uint32_t, 2> size{};
  std::vector<std::array<std::uint32_t, 2>> places;  ///< per rectangle: its lower left place
};

/// Places rectangles of whole numbers of places in a box that is about a square, the highest first, each where it
/// wastes least above those that lie there (Lévy 2002's packing of charts; coudert2024 S22). Several widths of the box
/// are tried; the smallest box wins. Sides are at least 1.
Packing pack_rectangles(const std::vector<std::array<std::uint32_t, 2>>& sizes);

/// All in one row, in their order.
Packing line_up_rectangles(const std::vector<std::array<std::uint32_t, 2>>& sizes);

}  // namespace strataflow
