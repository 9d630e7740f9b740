#include "kernels/drawing/palette.h"

#include <array>

namespace strataflow {

Colour categorical_colour(std::size_t index) {
  // Neighbours in the list differ in hue and lightness; red with green pairs differ in lightness for the colour-blind.
  static constexpr std::array<Colour, 16> hues = {{{66, 122, 180},
                                                   {240, 161, 64},
                                                   {88, 160, 84},
                                                   {206, 78, 74},
                                                   {146, 196, 217},
                                                   {148, 105, 172},
                                                   {233, 206, 102},
                                                   {120, 94, 72},
                                                   {226, 142, 176},
                                                   {46, 140, 140},
                                                   {168, 204, 122},
                                                   {94, 92, 150},
                                                   {214, 182, 146},
                                                   {160, 62, 104},
                                                   {134, 142, 150},
                                                   {232, 118, 92}}};
  const Colour hue = hues[index % hues.size()];
  const auto towards = [](std::uint8_t from, int to, int parts) {
    return static_cast<std::uint8_t>((from * (8 - parts) + to * parts) / 8);
  };
  switch (index / hues.size() % 3) {
    case 0:
      return hue;
    case 1:
      return {towards(hue.red, 255, 3), towards(hue.green, 255, 3), towards(hue.blue, 255, 3)};
    default:
      return {towards(hue.red, 0, 3), towards(hue.green, 0, 3), towards(hue.blue, 0, 3)};
  }
}

}  // namespace strataflow
