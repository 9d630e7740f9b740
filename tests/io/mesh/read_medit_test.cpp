#include "io/mesh/read_medit.h"

#include "io/mesh_samples.h"

namespace strataflow {
namespace {
using namespace support;

TEST(ReadMedit, references_are_patches_and_regions) {
  const InputData input = read_whole(read_medit, text_of(own_sample("medit/mixed.mesh")), "mixed.mesh");
  const VolumeMesh& mesh = input.volume;
  ASSERT_EQ(mesh.cell_count(), 5u);
  double volume = 0;
  for (std::size_t c = 0; c < 5; ++c) {
    EXPECT_GT(cell_volume(mesh, c), 0) << "cell " << c;
    volume += cell_volume(mesh, c);
  }
  EXPECT_NEAR(volume, 2.0, 1e-12);
  EXPECT_EQ(mesh.region_names, (std::vector<std::string>{"mixed_1", "mixed_2"}));
  EXPECT_EQ(input.surfaces.triangles.size(), 4u);
  ASSERT_EQ(input.surfaces.entities.size(), 2u);
  EXPECT_EQ(input.surfaces.entities[1].name, "mixed_6");
}

const std::string small =
    "MeshVersionFormatted 1\nDimension\n3\n# a comment\nVertices\n3\n0 0 0 1\n1 0 0 1\n0 1 0 "
    "1\nRidges\n1\n1\nEdges\n2\n1 2 4\n2 3 4\nTriangles\n1\n1 2 3 8\nEnd\n";

TEST(ReadMedit, edges_of_one_reference_that_follow_each_other_are_one_line) {
  const InputData input = read_whole(read_medit, small, "a.mesh");
  ASSERT_EQ(input.lines.size(), 1u);
  EXPECT_EQ(input.lines[0].points.size(), 3u);
  ASSERT_EQ(input.warnings.size(), 1u);
  EXPECT_NE(input.warnings[0].what.find("Ridges"), std::string::npos);
}

TEST(ReadMedit, crlf_reads_like_lf) {
  EXPECT_EQ(archived(read_whole(read_medit, with_crlf(small), "a.mesh")),
            archived(read_whole(read_medit, small, "a.mesh")));
}

TEST(ReadMedit, names_the_line_of_what_is_wrong) {
  expect_malformed(read_medit(replaced(small, "1 0 0 1", "1 -inf 0 1"), "a.mesh"),
                   "a.mesh:8: a coordinate is not a finite number", "a.mesh");
  expect_malformed(read_medit(replaced(small, "1 2 3 8", "1 2 4 8"), "a.mesh"), "point 4 does not exist; there are 3",
                   "a.mesh");
  expect_malformed(read_medit(replaced(small, "1 2 3 8", "0 2 3 8"), "a.mesh"), "point 0 does not exist", "a.mesh");
  expect_malformed(read_medit(replaced(small, "Triangles\n1", "Triangles\n99999999999"), "a.mesh"),
                   "which this file cannot hold", "a.mesh");
  expect_malformed(read_medit(replaced(small, "MeshVersion", "MashVersion"), "a.mesh"),
                   "the first word is not MeshVersionFormatted", "a.mesh");
  expect_malformed(read_medit(replaced(small, "End\n", ""), "a.mesh"), "the file ends without the word End", "a.mesh");
  expect_malformed(read_medit("", "a.mesh"), "MeshVersionFormatted", "a.mesh");
  const Result<InputData> flat = read_medit(replaced(small, "Dimension\n3", "Dimension\n2"), "a.mesh");
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.failure().code, FailureCode::unsupported);
}

TEST(ReadMedit, survives_damage) {
  expect_truncation_is_named(read_medit, text_of(own_sample("medit/mixed.mesh")), "a.mesh");
  expect_damage_is_survived(read_medit, text_of(own_sample("medit/mixed.mesh")), "a.mesh");
  expect_damage_is_survived(read_medit, small, "a.mesh");
}

}  // namespace
}  // namespace strataflow
