#include "kernels/remeshing/guarded/space_blocks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace strataflow {
namespace {

/// n × n × n cubes, a tenth apart.
std::vector<FloatBox> lattice(int n) {
  std::vector<FloatBox> boxes;
  for (int i = 0; i < n * n * n; ++i) {
    const auto at = [](int k) { return static_cast<float>(k); };
    const std::array<float, 3> low{at(i % n), at(i / n % n), at(i / n / n)};
    boxes.push_back({low, {low[0] + 0.9f, low[1] + 0.9f, low[2] + 0.9f}});
  }
  return boxes;
}

std::vector<std::uint32_t> all_of(const std::vector<FloatBox>& boxes) {
  std::vector<std::uint32_t> all(boxes.size());
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

TEST(CutSpace, puts_a_box_inside_one_block_or_across_the_sides_of_all_it_meets) {
  const std::vector<FloatBox> boxes = lattice(12);
  const std::vector<SpaceBlock> blocks = cut_space(boxes, all_of(boxes), 300, 0.45);
  ASSERT_GE(blocks.size(), 8u);
  std::vector<int> inside(boxes.size(), 0), across(boxes.size(), 0);
  for (const SpaceBlock& block : blocks) {
    EXPECT_LE(block.inside.size() + block.across.size(), 300u);
    EXPECT_TRUE(std::is_sorted(block.inside.begin(), block.inside.end()));
    EXPECT_TRUE(std::is_sorted(block.across.begin(), block.across.end()));
    for (const std::uint32_t i : block.inside) ++inside[i];
    for (const std::uint32_t i : block.across) ++across[i];
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
      const bool is_listed = std::binary_search(block.inside.begin(), block.inside.end(), i) ||
                             std::binary_search(block.across.begin(), block.across.end(), i);
      EXPECT_EQ(is_listed, overlap(boxes[i], block.box)) << i;
    }
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) EXPECT_TRUE(inside[i] == 1 ? across[i] == 0 : across[i] >= 2) << i;
  EXPECT_GT(std::count(across.begin(), across.end(), 0), 900);
}

TEST(CutSpace, cuts_elsewhere_for_another_share) {
  const std::vector<FloatBox> boxes = lattice(10);
  const auto across = [&](double share) {
    std::vector<char> is_across(boxes.size(), 0);
    for (const SpaceBlock& block : cut_space(boxes, all_of(boxes), 600, share))
      for (const std::uint32_t i : block.across) is_across[i] = 1;
    return is_across;
  };
  const std::vector<char> one = across(0.5), other = across(0.35);
  int count = 0, in_both = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) count += one[i], in_both += one[i] && other[i];
  EXPECT_GE(count, 100);  // a layer
  EXPECT_LE(in_both, count / 10) << "only where planes across different axes meet";
}

TEST(CutSpace, leaves_together_what_every_plane_would_cut) {
  std::vector<FloatBox> boxes = lattice(4);
  for (FloatBox& box : boxes) box.high = {9, 9, 9};
  const std::vector<SpaceBlock> blocks = cut_space(boxes, all_of(boxes), 5, 0.5);
  ASSERT_EQ(blocks.size(), 1u);
  EXPECT_EQ(blocks[0].inside, all_of(boxes));
}

TEST(CutSpace, looks_only_at_the_chosen) {
  const std::vector<FloatBox> boxes = lattice(4);
  const std::vector<SpaceBlock> blocks = cut_space(boxes, {3, 17}, 10, 0.5);
  ASSERT_EQ(blocks.size(), 1u);
  EXPECT_EQ(blocks[0].inside, (std::vector<std::uint32_t>{3, 17}));
}

}  // namespace
}  // namespace strataflow
