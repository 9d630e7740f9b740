#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/result.h"
#include "kernels/simulation_grid/pack_rectangles.h"
#include "kernels/simulation_grid/straight_pillars.h"

namespace strataflow {

/// How columns get indices.
enum class GridLayout {
  automatic,    ///< native where that is possible, else blocks or unstructured, whichever needs fewer numbers
  native,       ///< one block: every contact is one of neighbours by index, pillars are shared
  blocks,       ///< rectangles between separatrices, packed; contacts between blocks are NNCs (coudert2024 S22)
  unstructured  ///< every other I is a column with its own pillars; all lateral contacts are NNCs
};

/// Pieces of columns on straight pillars and where they lie in an index box.
struct ColumnPlacement {
  std::vector<PlanBlock> blocks;
  std::vector<ColumnPiece> pieces;  ///< none higher than the box; by block, from below
  Packing packing;                  ///< per piece its place in I and J
  std::uint32_t height = 0;         ///< of the box, along K
  std::string layout;               ///< native, blocks, unstructured
  std::string reason;               ///< why it is not native
};

/// What a place, a pillar and a connection cost a deck: ZCORN has 8 numbers per place, COORD 6 per pillar, NNC 7 per
/// connection.
struct DeckCost {
  double places = 0, pillars = 0, connections = 0;
  double numbers() const { return 8 * places + 6 * pillars + 7 * connections; }
};

/// The height of the index box with which a deck of these pieces has the fewest numbers: every piece fills a whole
/// column of places, so a box as high as the longest would be empty for the most part, and a low one cuts many columns,
/// each with pillars of its own and connections upwards. `packs`: pieces are packed, else they lie in a row.
std::uint32_t cheapest_height(const std::vector<PlanBlock>& blocks, const std::vector<ColumnPiece>& pieces, bool packs);

/// What a deck of pieces in a box of this height costs. Connections are those up and down and between blocks; what
/// fault offsets add is not known yet and alike in all layouts.
DeckCost deck_cost(const QuadMesh& plan, const std::vector<std::uint32_t>& opposite,
                   const std::vector<PlanBlock>& blocks, const std::vector<ColumnPiece>& pieces, std::uint32_t layers,
                   std::uint32_t height, bool packs);

/// Places the columns of a grid by a layout; `cells` is cells_by_column, `opposite` opposite_half_edges of the plan.
/// Blocks are cut along separatrices, at faults too where that comes cheaper. Fails with unsupported when the layout is
/// native and the plan allows none, or pillars are not straight within the tolerance.
Result<ColumnPlacement> place_columns(const HexGrid& hexes, const std::vector<std::uint32_t>& cells,
                                      const std::vector<std::uint32_t>& opposite, GridLayout layout,
                                      double tolerance_m);

}  // namespace strataflow
