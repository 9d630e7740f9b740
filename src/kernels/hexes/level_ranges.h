#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "kernels/hexes/split_along_faults.h"
#include "kernels/hexes/stratigraphic_levels.h"

namespace strataflow {

/// The levels a copy of a point lies on: several where units have no thickness.
struct LevelRange {
  std::uint32_t low = 1, high = 0;  ///< empty inside units
  bool is_empty() const { return low > high; }
  /// The level at which a tet of a unit holds the copy: the highest that the unit touches.
  std::uint32_t level_in(std::uint32_t unit) const { return std::clamp(unit + 1, low, high); }
};

/// Per copy of `split`, from the units around it and the facets of top and bottom.
std::vector<LevelRange> level_ranges(const LabelledTets& tets, const StratigraphicLevels& levels,
                                     const FaultSplit& split);

}  // namespace strataflow
