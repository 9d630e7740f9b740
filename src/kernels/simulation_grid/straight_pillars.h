#pragma once
#include <cstdint>
#include <vector>

#include "kernels/simulation_grid/plan_blocks.h"
#include "model/hex_grid.h"

namespace strataflow {

/// Layers [low, high) of a block of columns that share straight pillars.
struct ColumnPiece {
  std::uint32_t block = 0;
  std::uint32_t low = 0, high = 0;
};

/// The straight line through points that should lie on one: from the highest to the lowest (downwards if they have one
/// height), and how far the others lie from it, measured at their own heights.
struct StraightPillar {
  Vec3 upper, lower;
  double deviation_m = 0;
};
StraightPillar straight_pillar(const std::vector<Vec3>& points);

/// The corners of the cells in layers [low, high) around the place (i, j), 0 ≤ i ≤ size, between a block's columns.
std::vector<Vec3> points_on_pillar(const HexGrid& hexes, const std::vector<std::uint32_t>& cells,
                                   const PlanBlock& block, std::uint32_t i, std::uint32_t j, std::uint32_t low,
                                   std::uint32_t high);

/// Cuts blocks in K so that all corners lie within the tolerance of straight pillars, from below, every piece as high
/// as it can be, but no higher than `most_layers`. Blocks in which a single layer leaves its pillars (a curved fault
/// between columns that share them) fall apart into their quads first, which replaces `blocks`. One piece per block
/// where pillars are straight.
std::vector<ColumnPiece> split_at_bent_pillars(const HexGrid& hexes, const std::vector<std::uint32_t>& cells,
                                               std::vector<PlanBlock>& blocks, double tolerance_m,
                                               std::uint32_t most_layers = no_index);

}  // namespace strataflow
