#include "kernels/simulation_grid/plan_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/hex_grids.h"

namespace strataflow {
namespace {

using support::plan_grid;
using support::plan_star;

std::vector<std::uint32_t> opposite_of(const QuadMesh& plan) {
  const auto opposite = opposite_half_edges(plan);
  EXPECT_TRUE(opposite) << describe(opposite.failure());
  return opposite ? *opposite : std::vector<std::uint32_t>();
}

/// Quads are each in one block, full blocks only, and neighbours in a block touch in the plan by the sides they say.
void expect_sound(const std::vector<PlanBlock>& blocks, const QuadMesh& plan) {
  std::vector<int> used(plan.quads.size());
  for (const PlanBlock& block : blocks)
    for (std::uint32_t j = 0; j < block.size[1]; ++j)
      for (std::uint32_t i = 0; i < block.size[0]; ++i) {
        ASSERT_NE(block.quad(i, j), no_index);
        ++used[block.quad(i, j)];
        const auto corner = [&](std::uint32_t at_i, std::uint32_t at_j, std::uint32_t c) {
          return plan.quads[block.quad(at_i, at_j)][(block.turn(at_i, at_j) + c) % 4];
        };
        if (i > 0) {
          EXPECT_EQ(corner(i, j, 0), corner(i - 1, j, 1));
          EXPECT_EQ(corner(i, j, 3), corner(i - 1, j, 2));
        }
        if (j > 0) {
          EXPECT_EQ(corner(i, j, 0), corner(i, j - 1, 3));
          EXPECT_EQ(corner(i, j, 1), corner(i, j - 1, 2));
        }
      }
  EXPECT_TRUE(std::all_of(used.begin(), used.end(), [](int n) { return n == 1; }));
}

TEST(NativeBlock, walks_a_grid_whose_quads_start_at_any_corner) {
  QuadMesh plan = plan_grid(4, 3);
  for (std::size_t q = 0; q < plan.quads.size(); ++q)
    std::rotate(plan.quads[q].begin(), plan.quads[q].begin() + static_cast<long>(q % 4), plan.quads[q].end());
  const auto block = native_block(plan, opposite_of(plan));
  ASSERT_TRUE(block) << describe(block.failure());
  EXPECT_EQ(block->size[0] * block->size[1], 12u);
  expect_sound({*block}, plan);
}

TEST(NativeBlock, leaves_holes_where_the_plan_is_an_L) {
  const QuadMesh plan = plan_grid(4, 4, [](std::uint32_t i, std::uint32_t j) { return i >= 2 && j >= 2; });
  const auto block = native_block(plan, opposite_of(plan));
  ASSERT_TRUE(block) << describe(block.failure());
  EXPECT_EQ(std::count(block->quads.begin(), block->quads.end(), no_index), 4);
}

TEST(NativeBlock, refuses_a_singular_vertex_and_names_the_reason) {
  const QuadMesh plan = plan_star(5, 2);
  const auto block = native_block(plan, opposite_of(plan));
  ASSERT_FALSE(block);
  EXPECT_EQ(block.failure().code, FailureCode::unsupported);
  EXPECT_NE(block.failure().what.find("1 singular vert"), std::string::npos) << block.failure().what;
}

TEST(NativeBlock, refuses_two_parts) {
  const QuadMesh plan = plan_grid(3, 1, [](std::uint32_t i, std::uint32_t) { return i == 1; });
  EXPECT_FALSE(native_block(plan, opposite_of(plan)));
}

TEST(NativeBlock, refuses_a_ring_around_a_hole_that_turns_by_another_angle) {
  QuadMesh plan = plan_star(5, 3);  // without the quads around its middle: no singular vertex, but the turn is there
  plan.quads.erase(
      std::remove_if(plan.quads.begin(), plan.quads.end(),
                     [](const auto& quad) { return std::find(quad.begin(), quad.end(), 0u) != quad.end(); }),
      plan.quads.end());
  const auto block = native_block(plan, opposite_of(plan));
  ASSERT_FALSE(block);
  EXPECT_NE(block.failure().what.find("around a hole"), std::string::npos) << block.failure().what;
}

TEST(SeparatrixBlocks, are_the_diamonds_of_a_star) {
  for (const std::uint32_t valence : {3u, 5u, 6u}) {
    const QuadMesh plan = plan_star(valence, 4);
    const auto blocks = separatrix_blocks(plan, opposite_of(plan));
    EXPECT_EQ(blocks.size(), valence);
    expect_sound(blocks, plan);
  }
}

TEST(SeparatrixBlocks, cut_an_L_at_its_inner_corner) {
  const QuadMesh plan = plan_grid(4, 4, [](std::uint32_t i, std::uint32_t j) { return i >= 2 && j >= 2; });
  const auto blocks = separatrix_blocks(plan, opposite_of(plan));
  EXPECT_EQ(blocks.size(), 3u);
  expect_sound(blocks, plan);
}

TEST(SeparatrixBlocks, are_cut_at_faults_and_on_from_their_tips_and_turns_if_asked) {
  // A fault from the boundary that turns once and dies inside.
  QuadMesh plan = plan_grid(6, 6);
  plan.features = {{"F1", Role::fault}, {"side", Role::boundary}};
  const auto at = [](std::uint32_t i, std::uint32_t j) { return i + 7 * j; };
  plan.edges = {{at(2, 0), at(2, 1), 0},
                {at(2, 1), at(2, 2), 0},
                {at(2, 2), at(3, 2), 0},
                {at(3, 2), at(4, 2), 0},
                {at(0, 3), at(1, 3), 1}};
  const auto opposite = opposite_of(plan);
  EXPECT_EQ(separatrix_blocks(plan, opposite).size(), 1u);
  const auto blocks = separatrix_blocks(plan, opposite, true);
  expect_sound(blocks, plan);
  // Lines run up from the turn, left from it, and right from the tip.
  EXPECT_EQ(blocks.size(), 4u);
}

TEST(SeparatrixBlocks, fall_into_quads_where_a_ring_has_no_irregular_vertex) {
  QuadMesh plan;
  for (std::uint32_t n = 0; n < 8; ++n)
    for (const double r : {1.0, 2.0})
      plan.points.push_back({r * std::cos(n * 0.78539816), r * std::sin(n * 0.78539816), 0});
  for (std::uint32_t n = 0; n < 8; ++n) plan.quads.push_back({2 * n, 2 * n + 1, (2 * n + 3) % 16, (2 * n + 2) % 16});
  const auto blocks = separatrix_blocks(plan, opposite_of(plan));
  EXPECT_EQ(blocks.size(), 8u);
  expect_sound(blocks, plan);
}

TEST(OppositeHalfEdges, refuse_an_edge_of_three_quads_and_neighbours_that_turn_against_each_other) {
  QuadMesh plan = plan_grid(2, 1);
  std::reverse(plan.quads[1].begin(), plan.quads[1].end());
  EXPECT_FALSE(opposite_half_edges(plan));
  plan = plan_grid(2, 1);
  plan.quads.push_back(plan.quads[1]);
  EXPECT_FALSE(opposite_half_edges(plan));
  plan.quads[2] = {0, 1, 99, 2};
  EXPECT_FALSE(opposite_half_edges(plan));
}

TEST(SingleBlocks, go_from_left_to_right) {
  const auto blocks = single_blocks(plan_grid(2, 2));
  ASSERT_EQ(blocks.size(), 4u);
  EXPECT_EQ(blocks.front().quads[0], 0u);
  EXPECT_EQ(blocks.back().quads[0], 3u);
}

}  // namespace
}  // namespace strataflow
