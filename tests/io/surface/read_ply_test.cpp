#include "io/surface/read_ply.h"

#include "io/mesh_damage.h"

namespace strataflow {
namespace {
using namespace support;

const std::string coloured =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\nproperty float "
    "z\nproperty uchar red\n"
    "element face 2\nproperty uchar flag\nproperty list uchar int vertex_index\nelement edge 1\nproperty int "
    "vertex1\nproperty int vertex2\nend_header\n"
    "0 0 0 255\n1 0 0 128\n1 1 0 0\n0 1 0 1\n7 3 0 1 2\n7 4 0 1 2 3\n0 1\n";

TEST(ReadPly, reads_lists_properties_and_names_what_it_leaves_aside) {
  const InputData input = read_whole(read_ply, coloured, "a.ply");
  EXPECT_EQ(input.surfaces.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));
  ASSERT_EQ(input.surfaces.properties.size(), 1u);
  EXPECT_EQ(input.surfaces.properties[0].values, (std::vector<double>{255, 128, 0, 1}));
  ASSERT_EQ(input.warnings.size(), 2u);
  EXPECT_NE(input.warnings[0].what.find("'flag'"), std::string::npos);
  EXPECT_NE(input.warnings[1].what.find("'edge'"), std::string::npos);
}

TEST(ReadPly, ascii_and_both_byte_orders_hold_the_same) {
  const InputData ascii = read_whole(read_ply, text_of(own_sample("ply/ascii.ply")), "a.ply");
  EXPECT_EQ(ascii.surfaces.triangles.size(), 4u);
  EXPECT_EQ(archived(read_whole(read_ply, text_of(own_sample("ply/binary_little.ply")), "a.ply")), archived(ascii));
  EXPECT_EQ(archived(read_whole(read_ply, text_of(own_sample("ply/binary_big.ply")), "a.ply")), archived(ascii));
}

TEST(ReadPly, points_without_faces_are_a_point_set) {
  const InputData input = read_whole(read_ply,
                                     "ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double "
                                     "y\nproperty double z\nend_header\n500000.125 6000000.0625 -1234.5\n1 2 3\n",
                                     "picks.ply");
  ASSERT_EQ(input.point_sets.size(), 1u);
  EXPECT_EQ(input.point_sets[0].points[0], (Vec3{500000.125, 6000000.0625, -1234.5}));
  EXPECT_EQ(input.point_sets[0].name, "picks");
}

TEST(ReadPly, crlf_reads_like_lf) {
  EXPECT_EQ(archived(read_whole(read_ply, with_crlf(coloured), "a.ply")),
            archived(read_whole(read_ply, coloured, "a.ply")));
}

TEST(ReadPly, names_what_is_wrong) {
  expect_malformed(read_ply(replaced(coloured, "1 1 0 0", "1 nan 0 0"), "a.ply"),
                   "a.ply:18: vertex 2 has a coordinate that is not a finite number", "a.ply");
  expect_malformed(read_ply(replaced(coloured, "3 0 1 2\n", "3 0 1 4\n"), "a.ply"),
                   "face 0 refers to a point that does not exist; there are 4", "a.ply");
  expect_malformed(read_ply(replaced(coloured, "vertex 4", "vertex 4000000000"), "a.ply"),
                   "which this file cannot hold", "a.ply");
  expect_malformed(read_ply(replaced(coloured, "ply\n", "plx\n"), "a.ply"), "the first line is not 'ply'", "a.ply");
  expect_malformed(read_ply(replaced(coloured, "float z", "float w"), "a.ply"), "no x, y and z", "a.ply");
  expect_malformed(read_ply(replaced(coloured, "float z", "quad z"), "a.ply"), "unknown type 'quad'", "a.ply");
  expect_malformed(read_ply(replaced(coloured, "uchar int", "float int"), "a.ply"), "unknown type of a list's length",
                   "a.ply");
  expect_malformed(read_ply("", "a.ply"), "the first line is not 'ply'", "a.ply");
}

TEST(ReadPly, a_property_that_only_some_of_its_vertices_have_is_refused) {
  const std::string two_lists =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
      "property float q\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0 5\n1 0 0\n0 1 0\n3 0 1 2\n";
  expect_malformed(read_ply(two_lists, "a.ply"), "point property 'q' has 1 values for 3 points", "a.ply");
}

TEST(ReadPly, survives_damage) {
  for (const char* name : {"ply/ascii.ply", "ply/binary_little.ply", "ply/binary_big.ply"}) {
    expect_truncation_is_named(read_ply, text_of(own_sample(name)), name);
    expect_damage_is_survived(read_ply, text_of(own_sample(name)), name);
  }
}

TEST(ReadPly, reads_the_drogon_horizons) {
  STRATAFLOW_NEEDS_SHARED_DATA();
  for (const char* name : {"01_topvolantis", "02_toptherys", "03_topvolon", "04_basevolantis"}) {
    const Result<std::string> bytes = read_input_text(shared_data() / "drogon" / (std::string(name) + ".ply.gz"));
    ASSERT_TRUE(bytes);
    const InputData input = read_whole(read_ply, *bytes, std::string(name) + ".ply.gz");
    EXPECT_EQ(input.surfaces.points.size(), 48125u);
    EXPECT_EQ(input.surfaces.triangles.size(), 95352u);
    EXPECT_EQ(input.surfaces.entities.at(0).name, name);
  }
}

}  // namespace
}  // namespace strataflow
