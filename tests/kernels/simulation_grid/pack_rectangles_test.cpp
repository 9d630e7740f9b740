#include "kernels/simulation_grid/pack_rectangles.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

using Sizes = std::vector<std::array<std::uint32_t, 2>>;

/// Whether all lie in the box with an empty row or column between any two.
void expect_apart(const Sizes& sizes, const Packing& packing) {
  ASSERT_EQ(packing.places.size(), sizes.size());
  for (std::size_t a = 0; a < sizes.size(); ++a) {
    for (int axis = 0; axis < 2; ++axis) EXPECT_LE(packing.places[a][axis] + sizes[a][axis], packing.size[axis]);
    for (std::size_t b = 0; b < a; ++b) {
      bool is_apart = false;
      for (int axis = 0; axis < 2; ++axis)
        is_apart = is_apart || packing.places[a][axis] + sizes[a][axis] < packing.places[b][axis] ||
                   packing.places[b][axis] + sizes[b][axis] < packing.places[a][axis];
      EXPECT_TRUE(is_apart) << "rectangles " << a << " and " << b << " touch";
    }
  }
}

TEST(PackRectangles, never_lets_two_touch) {
  Sizes sizes;
  for (std::uint32_t n = 0; n < 60; ++n) sizes.push_back({1 + n * 7 % 5, 1 + n * 11 % 9});
  expect_apart(sizes, pack_rectangles(sizes));
  expect_apart(sizes, line_up_rectangles(sizes));
}

TEST(PackRectangles, puts_equal_squares_into_about_a_square) {
  const Sizes sizes(16, {3, 3});
  const Packing packing = pack_rectangles(sizes);
  expect_apart(sizes, packing);
  EXPECT_LE(packing.size[0] * packing.size[1], 15u * 15u);
}

TEST(PackRectangles, fills_a_box_by_half_where_sizes_differ) {
  Sizes sizes;
  std::uint64_t area = 0;
  for (std::uint32_t n = 1; n <= 12; ++n) sizes.push_back({2 * n, 30 - 2 * n}), area += 2 * n * (30 - 2 * n);
  const Packing packing = pack_rectangles(sizes);
  expect_apart(sizes, packing);
  EXPECT_GT(static_cast<double>(area) / (packing.size[0] * packing.size[1]), 0.5);
}

TEST(LineUpRectangles, leaves_every_other_place_empty_between_single_places) {
  const Packing packing = line_up_rectangles(Sizes(3, {1, 1}));
  EXPECT_EQ(packing.size, (std::array<std::uint32_t, 2>{5, 1}));
  EXPECT_EQ(packing.places[2], (std::array<std::uint32_t, 2>{4, 0}));
}

}  // namespace
}  // namespace strataflow
