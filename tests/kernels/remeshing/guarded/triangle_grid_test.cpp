#include "kernels/remeshing/guarded/triangle_grid.h"

#include <gtest/gtest.h>

#include <set>

namespace strataflow {
namespace {

FloatBox cube(float x, float size) { return {{x, x, x}, {x + size, x + size, x + size}}; }

std::set<std::uint32_t> found(const TriangleGrid& grid, const FloatBox& box) {
  std::set<std::uint32_t> triangles;
  grid.visit(box, [&](std::uint32_t t) { triangles.insert(t); });
  return triangles;
}

TEST(TriangleGrid, finds_what_overlaps_small_and_large_until_it_is_erased) {
  TriangleGrid grid({{0, 0, 0}, {100, 100, 100}}, 1, 1u << 20);
  grid.insert(0, cube(10, 0.5f));
  grid.insert(1, cube(10.2f, 60));
  grid.insert(7, cube(50, 1));
  EXPECT_EQ(found(grid, cube(10.1f, 0.3f)), (std::set<std::uint32_t>{0, 1}));
  EXPECT_EQ(found(grid, cube(50.5f, 0.1f)), (std::set<std::uint32_t>{1, 7}));
  grid.erase(1);
  EXPECT_EQ(found(grid, cube(0, 99)), (std::set<std::uint32_t>{0, 7}));
}

TEST(TriangleGrid, follows_a_box_that_moves_to_other_cells_or_grows) {
  TriangleGrid grid({{0, 0, 0}, {100, 100, 100}}, 1, 1u << 20);
  grid.insert(3, cube(10, 0.5f));
  grid.move(3, cube(10.1f, 0.5f));
  EXPECT_EQ(found(grid, cube(10.55f, 0.2f)), (std::set<std::uint32_t>{3}));
  grid.move(3, cube(70, 0.5f));
  EXPECT_TRUE(found(grid, cube(10, 5)).empty());
  grid.move(3, cube(0, 90));
  EXPECT_EQ(found(grid, cube(33, 0.5f)), (std::set<std::uint32_t>{3}));
}

TEST(TriangleGrid, finds_what_lies_outside_its_box) {
  TriangleGrid grid({{0, 0, 0}, {10, 10, 10}}, 1, 1u << 10);
  grid.insert(0, cube(-50, 1));
  grid.insert(1, cube(40, 1));
  EXPECT_EQ(found(grid, cube(-49.5f, 1)), (std::set<std::uint32_t>{0}));
  EXPECT_EQ(found(grid, cube(40.5f, 1)), (std::set<std::uint32_t>{1}));
}

TEST(TriangleGrid, widens_its_cells_rather_than_exceed_the_number_allowed) {
  TriangleGrid grid({{0, 0, 0}, {100, 100, 100}}, 1e-6, 1000);
  grid.insert(0, cube(10, 0.5f));
  EXPECT_EQ(found(grid, cube(10, 1)), (std::set<std::uint32_t>{0}));
}

}  // namespace
}  // namespace strataflow
