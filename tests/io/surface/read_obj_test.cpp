#include "io/surface/read_obj.h"

#include "io/mesh_damage.h"

namespace strataflow {
namespace {
using namespace support;

TEST(ReadObj, a_group_is_a_patch_and_comes_back_after_another_group) {
  const InputData input = read_whole(read_obj, text_of(own_sample("obj/groups.obj")), "groups.obj");
  const TriangleSoup& soup = input.surfaces;
  ASSERT_EQ(soup.points.size(), 5u);
  ASSERT_EQ(soup.triangles.size(), 4u);  // a quad, and two triangles
  EXPECT_EQ(soup.triangle_patch, (std::vector<std::uint32_t>{0, 0, 1, 0}));
  ASSERT_EQ(soup.entities.size(), 2u);
  EXPECT_EQ(soup.entities[0].name, "F1");
  EXPECT_EQ(soup.entities[1].name, "Top horizon");
  EXPECT_EQ(soup.triangles[1], (Triangle{0, 2, 3}));
  EXPECT_EQ(soup.triangles[2], (Triangle{0, 1, 4})) << "negative indices count from the last point";
  ASSERT_EQ(input.lines.size(), 1u);
  EXPECT_EQ(input.lines[0].points.size(), 3u);
  ASSERT_EQ(input.warnings.size(), 3u) << "mtllib, vn, vt";
  EXPECT_NE(input.warnings[0].what.find("mtllib"), std::string::npos);
}

TEST(ReadObj, without_groups_the_patch_is_named_after_the_file) {
  const InputData input = read_whole(read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "cube_test.obj");
  ASSERT_EQ(input.surfaces.entities.size(), 1u);
  EXPECT_EQ(input.surfaces.entities[0].name, "cube_test");
}

TEST(ReadObj, groups_inside_an_object_are_patches_of_one_entity) {
  const InputData input =
      read_whole(read_obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\no F1\ng F1_1\nf 1 2 3\ng F1_2\nf 3 2 1\n", "a.obj");
  EXPECT_EQ(input.surfaces.patch_entity, (std::vector<std::uint32_t>{0, 0}));
}

TEST(ReadObj, crlf_reads_like_lf) {
  const std::string text = text_of(own_sample("obj/groups.obj"));
  EXPECT_EQ(archived(read_whole(read_obj, with_crlf(text), "a.obj")), archived(read_whole(read_obj, text, "a.obj")));
}

TEST(ReadObj, names_the_line_of_what_is_wrong) {
  const std::string text = text_of(own_sample("obj/groups.obj"));
  expect_malformed(read_obj(replaced(text, "v 1 1 0", "v 1 nan 0"), "a.obj"),
                   "a.obj:5: a coordinate is not a finite number", "a.obj");
  expect_malformed(read_obj(replaced(text, "v 1 1 0", "v 1 inf 0"), "a.obj"), "a.obj:5:", "a.obj");
  expect_malformed(read_obj(replaced(text, "f 2 3 5", "f 2 3 6"), "a.obj"), "'6' is none of the 5 points", "a.obj");
  expect_malformed(read_obj(replaced(text, "f 2 3 5", "f 2 3 0"), "a.obj"), "'0' is none", "a.obj");
  expect_malformed(read_obj(replaced(text, "f 2 3 5", "f 2 3 -6"), "a.obj"), "'-6' is none", "a.obj");
  expect_malformed(read_obj(replaced(text, "f 2 3 5", "f 2 3"), "a.obj"), "a face needs three points", "a.obj");
  expect_malformed(read_obj(replaced(text, "f 2 3 5", "f 2 3 99999999999999999999"), "a.obj"), "is none", "a.obj");
  expect_malformed(read_obj("", "a.obj"), "not an OBJ file", "a.obj");
  expect_malformed(read_obj("solid cube\n", "a.obj"), "not an OBJ file", "a.obj");
}

TEST(ReadObj, survives_damage) {
  const std::string text = text_of(own_sample("obj/groups.obj"));
  expect_truncation_is_named(read_obj, text, "a.obj", true);
  expect_damage_is_survived(read_obj, text, "a.obj");
}

TEST(ReadObj, reads_the_gdsa_cubes) {
  STRATAFLOW_NEEDS_SHARED_DATA();
  const InputData first =
      read_whole(read_obj, text_of(shared_data() / "gdsa-cubes/cube_test_01.obj"), "cube_test_01.obj");
  EXPECT_EQ(first.surfaces.triangles.size(), 1632u);
  EXPECT_EQ(first.surfaces.points.size(), 761u);
  const InputData second =
      read_whole(read_obj, text_of(shared_data() / "gdsa-cubes/cube_test_02.obj"), "cube_test_02.obj");
  EXPECT_EQ(second.surfaces.triangles.size(), 1231u);
  EXPECT_EQ(second.surfaces.points.size(), 583u);
}

}  // namespace
}  // namespace strataflow
