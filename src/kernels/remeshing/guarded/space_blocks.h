#pragma once
#include <cstdint>
#include <vector>

#include "kernels/intersection/bounding_volume_tree.h"

namespace strataflow {

/// A box of space, unbounded outwards.
struct SpaceBlock {
  FloatBox box;
  std::vector<std::uint32_t> inside;  ///< what lies in the box and touches none of its sides, ascending
  std::vector<std::uint32_t> across;  ///< what touches a side, ascending: also in other blocks
};

/// Cuts space by planes across one axis each until no block holds more than `most` of the boxes `chosen` (ascending),
/// each time where few boxes are cut, about `share` of them on one side; a block stays larger where every plane would
/// cut a quarter of it. Depends on the arguments alone.
std::vector<SpaceBlock> cut_space(const std::vector<FloatBox>& boxes, std::vector<std::uint32_t> chosen,
                                  std::size_t most, double share);

}  // namespace strataflow
