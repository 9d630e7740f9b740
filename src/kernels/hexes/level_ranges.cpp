#include "kernels/hexes/level_ranges.h"

namespace strataflow {

std::vector<LevelRange> level_ranges(const LabelledTets& tets, const StratigraphicLevels& levels,
                                     const FaultSplit& split) {
  struct Units {
    std::uint32_t lowest = no_index, highest = 0;
    bool is_bottom = false, is_top = false;
  };
  std::vector<Units> units(split.original.size());
  for (std::uint32_t t = 0; t < split.tets.size(); ++t)
    for (std::uint32_t k = 0; k < 4; ++k) {
      Units& around = units[split.tets[t][k]];
      around.lowest = std::min(around.lowest, levels.unit[t]);
      around.highest = std::max(around.highest, levels.unit[t]);
      for (std::uint32_t face = 0; face < 4; ++face) {
        if (face == k) continue;
        around.is_bottom = around.is_bottom || tets.has(4 * t + face, SheetKind::bottom);
        around.is_top = around.is_top || tets.has(4 * t + face, SheetKind::top);
      }
    }
  std::vector<LevelRange> ranges;
  ranges.reserve(units.size());
  for (const Units& around : units) {
    LevelRange range{around.lowest + 1, around.highest};
    if (around.is_bottom) range.low = 0;
    if (around.is_top) range.high = levels.unit_count();
    ranges.push_back(range);
  }
  return ranges;
}

}  // namespace strataflow
