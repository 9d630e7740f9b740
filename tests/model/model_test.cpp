#include <gtest/gtest.h>

#include "base/archive.h"
#include "model/box3.h"
#include "model/geology.h"
#include "model/volume_mesh.h"

namespace strataflow {
namespace {

TEST(Role, words_and_roles_are_one_to_one) {
  for (int r = 0; r <= static_cast<int>(Role::curve); ++r) {
    const auto role = static_cast<Role>(r);
    EXPECT_EQ(role_from(to_string(role)), role);
  }
  EXPECT_FALSE(role_from("Fault").has_value());
}

TEST(Box3, is_empty_until_it_takes_a_point) {
  Box3 box;
  EXPECT_TRUE(box.is_empty());
  EXPECT_EQ(box.diagonal_m(), 0.0);
  box.take(Vec3{1, 2, 3});
  EXPECT_FALSE(box.is_empty());
  box.take(Vec3{4, 6, 3});
  EXPECT_DOUBLE_EQ(box.diagonal_m(), 5.0);
}

TEST(VolumeMesh, archives_and_comes_back) {
  VolumeMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::uint32_t cell[] = {0, 1, 2, 3};
  mesh.add_cell(CellType::tetrahedron, cell, 0);
  mesh.region_names = {"one"};
  mesh.changes = {{"inserted", "a point", "it was needed"}};
  const auto back = unarchived<VolumeMesh>(archived(mesh));
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(archived(*back), archived(mesh));
  EXPECT_EQ(back->cell_count(), 1u);
}

TEST(Vec3, orders_by_x_then_y_then_z) {
  EXPECT_TRUE(lexicographically_less({0, 5, 5}, {1, 0, 0}));
  EXPECT_TRUE(lexicographically_less({1, 0, 5}, {1, 1, 0}));
  EXPECT_TRUE(lexicographically_less({1, 1, 0}, {1, 1, 1}));
  EXPECT_FALSE(lexicographically_less({1, 1, 1}, {1, 1, 1}));
}

}  // namespace
}  // namespace strataflow
