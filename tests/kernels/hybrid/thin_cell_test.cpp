#include "kernels/hybrid/thin_cell.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};

TEST(CellBetween, is_a_prism_a_pyramid_or_a_tetrahedron) {
  const ThinCell prism = cell_between({0, 1, 2}, {3, 4, 5});
  EXPECT_EQ(prism.type, CellType::prism);
  EXPECT_EQ(state_of(prism, points), ThinCellState::sound);
  EXPECT_DOUBLE_EQ(volume_of(prism, points), 0.5);
  for (int k = 0; k < 3; ++k) {  // whichever corner coincides
    Triangle top{3, 4, 5};
    top[k] = k;
    const ThinCell pyramid = cell_between({0, 1, 2}, top);
    EXPECT_EQ(pyramid.type, CellType::pyramid);
    EXPECT_EQ(state_of(pyramid, points), ThinCellState::sound);
    EXPECT_DOUBLE_EQ(volume_of(pyramid, points), 1.0 / 3);
    Triangle one{0, 1, 2};
    one[k] = 3 + k;
    const ThinCell tetrahedron = cell_between({0, 1, 2}, one);
    EXPECT_EQ(tetrahedron.type, CellType::tetrahedron);
    EXPECT_EQ(state_of(tetrahedron, points), ThinCellState::sound);
    EXPECT_DOUBLE_EQ(volume_of(tetrahedron, points), 1.0 / 6);
  }
}

TEST(ConeOver, is_positive_on_the_inside_of_a_face) {
  EXPECT_EQ(state_of(cone_over({0, 2, 1, no_index}, 3), points), ThinCellState::sound);
  EXPECT_EQ(state_of(cone_over({0, 1, 4, 3}, 2), points), ThinCellState::sound);
  EXPECT_EQ(state_of(cone_over({0, 1, 2, no_index}, 3), points), ThinCellState::inverted);
}

TEST(StateOf, tells_flat_from_inverted) {
  const std::vector<Vec3> flat{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, 1e-5}};
  EXPECT_EQ(state_of(tetrahedron_of(0, 1, 2, 3), flat), ThinCellState::flat);
  EXPECT_EQ(state_of(tetrahedron_of(0, 2, 1, 3), flat), ThinCellState::inverted);
}

TEST(StateOf, sees_a_prism_turn_over_half_way_up) {
  const std::vector<Vec3> twisted{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}, {0, 1, 1}, {1, 0, 1}};
  EXPECT_EQ(state_of(cell_between({0, 1, 2}, {3, 4, 5}), twisted), ThinCellState::inverted);
}

}  // namespace
}  // namespace strataflow
