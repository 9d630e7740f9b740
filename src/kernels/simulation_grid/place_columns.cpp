#include "kernels/simulation_grid/place_columns.h"

#include <algorithm>
#include <limits>

namespace strataflow {

namespace {
/// Places in I and J, pillars and columns of a block, with the empty ones beside it.
std::array<double, 3> footprint(const PlanBlock& block, bool packs) {
  const double columns = static_cast<double>(block.quads.size()) -
                         static_cast<double>(std::count(block.quads.begin(), block.quads.end(), no_index));
  const double area = packs ? (block.size[0] + 1.0) * (block.size[1] + 1.0) : 2.0;
  return {area, packs ? area : 4.0, columns};
}

struct Candidate {
  ColumnPlacement placement;
  double numbers = std::numeric_limits<double>::infinity();
};

Candidate make_candidate(const HexGrid& hexes, const std::vector<std::uint32_t>& cells,
                         const std::vector<std::uint32_t>& opposite, std::vector<PlanBlock> blocks, bool packs,
                         double tolerance_m) {
  ColumnPlacement made;
  made.layout = packs ? "blocks" : "unstructured";
  made.blocks = std::move(blocks);
  made.pieces = split_at_bent_pillars(hexes, cells, made.blocks, tolerance_m);
  made.height = cheapest_height(made.blocks, made.pieces, packs);
  if (std::any_of(made.pieces.begin(), made.pieces.end(),
                  [&](const ColumnPiece& piece) { return piece.high - piece.low > made.height; }))
    made.pieces = split_at_bent_pillars(hexes, cells, made.blocks, tolerance_m, made.height);
  const double numbers =
      deck_cost(hexes.plan, opposite, made.blocks, made.pieces, hexes.layers, made.height, packs).numbers();
  return {std::move(made), numbers};
}
}  // namespace

std::uint32_t cheapest_height(const std::vector<PlanBlock>& blocks, const std::vector<ColumnPiece>& pieces,
                              bool packs) {
  std::vector<std::array<double, 3>> of_length;  // footprints of all pieces of a length, together
  for (const ColumnPiece& piece : pieces) {
    const std::size_t length = piece.high - piece.low;
    if (of_length.size() <= length) of_length.resize(length + 1);
    const auto own = footprint(blocks[piece.block], packs);
    for (std::size_t n = 0; n < 3; ++n) of_length[length][n] += own[n];
  }
  std::uint32_t best = 1;
  double fewest = std::numeric_limits<double>::infinity();
  for (std::uint32_t height = static_cast<std::uint32_t>(of_length.size()) - 1; height > 0; --height) {
    DeckCost cost;
    for (std::size_t length = 1; length < of_length.size(); ++length) {
      const double cuts = static_cast<double>((length + height - 1) / height);
      const auto [area, pillars, columns] = of_length[length];
      cost.places += cuts * area * height, cost.pillars += cuts * pillars, cost.connections += cuts * columns;
    }
    if (cost.numbers() < fewest) fewest = cost.numbers(), best = height;
  }
  return best;
}

DeckCost deck_cost(const QuadMesh& plan, const std::vector<std::uint32_t>& opposite,
                   const std::vector<PlanBlock>& blocks, const std::vector<ColumnPiece>& pieces, std::uint32_t layers,
                   std::uint32_t height, bool packs) {
  DeckCost cost;
  for (const ColumnPiece& piece : pieces) {
    const auto [area, pillars, columns] = footprint(blocks[piece.block], packs);
    cost.places += area * height, cost.pillars += pillars;
    if (piece.low > 0) cost.connections += columns;
  }
  std::vector<std::uint32_t> block_of_quad(plan.quads.size(), no_index);
  for (std::uint32_t b = 0; b < blocks.size(); ++b)
    for (const std::uint32_t quad : blocks[b].quads)
      if (quad != no_index) block_of_quad[quad] = b;
  for (std::size_t h = 0; h < opposite.size(); ++h)
    if (opposite[h] != no_index && h < opposite[h] && block_of_quad[h / 4] != block_of_quad[opposite[h] / 4])
      cost.connections += layers;
  return cost;
}

Result<ColumnPlacement> place_columns(const HexGrid& hexes, const std::vector<std::uint32_t>& cells,
                                      const std::vector<std::uint32_t>& opposite, GridLayout layout,
                                      double tolerance_m) {
  std::string reason;
  if (layout == GridLayout::automatic || layout == GridLayout::native) {
    auto native = native_block(hexes.plan, opposite);
    if (native) {
      ColumnPlacement placement{{std::move(*native)}, {}, {}, hexes.layers, "native", {}};
      placement.pieces = split_at_bent_pillars(hexes, cells, placement.blocks, tolerance_m);
      if (placement.pieces.size() == 1) {
        placement.packing = {placement.blocks[0].size, {{0, 0}}};
        return placement;
      }
      reason = "corners lie further than pillar_tolerance_m from straight pillars";
    } else {
      reason = native.failure().what;
    }
    if (layout == GridLayout::native)
      return Failure{FailureCode::unsupported, "the grid has no native layout: " + reason,
                     "choose the layout blocks or unstructured"};
  }
  Candidate best;
  const auto compare = [&](std::vector<PlanBlock> blocks, bool packs) {
    Candidate other = make_candidate(hexes, cells, opposite, std::move(blocks), packs, tolerance_m);
    if (other.numbers < best.numbers) best = std::move(other);
  };
  if (layout != GridLayout::unstructured)
    for (const bool at_faults : {false, true})  // the sides of a curved fault cannot share pillars
      compare(separatrix_blocks(hexes.plan, opposite, at_faults), true);
  if (layout != GridLayout::blocks) compare(single_blocks(hexes.plan), false);
  ColumnPlacement& placement = best.placement;
  std::vector<std::array<std::uint32_t, 2>> sizes;
  for (const ColumnPiece& piece : placement.pieces) sizes.push_back(placement.blocks[piece.block].size);
  placement.packing = placement.layout == "blocks" ? pack_rectangles(sizes) : line_up_rectangles(sizes);
  placement.reason = reason;
  return std::move(placement);
}

}  // namespace strataflow
