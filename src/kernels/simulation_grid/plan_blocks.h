#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "model/quad_mesh.h"

namespace strataflow {

/// Per half-edge h = 4·quad + s, which runs from corner s of the quad to corner (s + 1) mod 4: the half-edge of the
/// quad across, or no_index at the boundary. Fails with invalid_input where three quads share an edge or two
/// neighbours turn against each other.
Result<std::vector<std::uint32_t>> opposite_half_edges(const QuadMesh& plan);

/// Quads that have indices (i, j) together (coudert2024 S22). The quad at (i, j) has its corner (turn + c) mod 4 at the
/// corner c of its place, c counting (0,0), (1,0), (1,1), (0,1).
struct PlanBlock {
  std::array<std::uint32_t, 2> size{};
  std::vector<std::uint32_t> quads;  ///< I fastest; no_index where the block has a hole
  std::vector<std::uint32_t> turns;
  std::uint32_t quad(std::uint32_t i, std::uint32_t j) const { return quads[i + std::size_t{size[0]} * j]; }
  std::uint32_t turn(std::uint32_t i, std::uint32_t j) const { return turns[i + std::size_t{size[0]} * j]; }
};

/// A block for every quad, by the x, then the y of their middles, so that the last one lies to the right of the first.
std::vector<PlanBlock> single_blocks(const QuadMesh& plan);

/// The whole plan as one block, with holes where it is no rectangle, if neighbours by index and neighbours in the plan
/// are the same. Fails with unsupported and the reason: a singular vertex inside, several parts, parts that overlap or
/// meet in index space.
Result<PlanBlock> native_block(const QuadMesh& plan, const std::vector<std::uint32_t>& opposite);

/// Full rectangles of quads, cut along separatrices: from every irregular vertex a line of edges runs straight on along
/// every edge, all at the same speed, until it meets the boundary, an irregular vertex or a line that came before.
/// Irregular: other than four quads around a vertex inside, more than two at the boundary. With `at_faults` the edges
/// on features of role fault are cut too, and lines run on from where faults end or turn. By their first quads.
std::vector<PlanBlock> separatrix_blocks(const QuadMesh& plan, const std::vector<std::uint32_t>& opposite,
                                         bool at_faults = false);

}  // namespace strataflow
