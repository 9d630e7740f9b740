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

TEST(Role, a_job_file_may_say_every_one_but_unknown) {
  EXPECT_EQ(role_words().size(), static_cast<std::size_t>(Role::curve));
  for (const std::string_view word : role_words()) EXPECT_NE(role_from(word).value_or(Role::unknown), Role::unknown);
}

TEST(Entity, the_youngest_cuts_the_others_off_and_of_equals_the_last_counts) {
  const std::vector<Entity> all{{"F", Role::fault}, {"H1", Role::horizon}, {"U", Role::unconformity}, {"box", Role::boundary}, {"?", Role::unknown}};
  EXPECT_EQ(youngest_of(all, {0, 1, 2, 3, 4}), 3u);
  EXPECT_EQ(youngest_of(all, {0, 1, 2}), 0u);
  EXPECT_EQ(youngest_of(all, {2, 1, 4}), 2u);
  EXPECT_EQ(youngest_of(all, {4}), 4u);
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
