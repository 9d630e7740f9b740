#include "io/mesh/read_gmsh.h"

#include "io/mesh_samples.h"

namespace strataflow {
namespace {
using namespace support;

TEST(ReadGmsh, version_2_ascii_and_binary_hold_the_same) {
  const InputData ascii = read_whole(read_gmsh, text_of(own_sample("gmsh/v22_ascii.msh")), "a.msh");
  expect_the_mixed_mesh(ascii);
  EXPECT_EQ(ascii.volume.region_names, (std::vector<std::string>{"upper", "lower"}));
  ASSERT_EQ(ascii.surfaces.entities.size(), 2u);
  EXPECT_EQ(ascii.surfaces.entities[0].name, "top A");
  EXPECT_EQ(ascii.surfaces.entities[1].name, "F 1");
  EXPECT_EQ(archived(read_whole(read_gmsh, text_of(own_sample("gmsh/v22_binary.msh")), "a.msh")), archived(ascii));
}

TEST(ReadGmsh, version_4_ascii_and_binary_hold_the_same) {
  const InputData ascii = read_whole(read_gmsh, text_of(own_sample("gmsh/v41_ascii.msh")), "a.msh");
  EXPECT_EQ(ascii.volume.cell_count(), 5u);
  EXPECT_EQ(archived(read_whole(read_gmsh, text_of(own_sample("gmsh/v41_binary.msh")), "a.msh")), archived(ascii));
}

const std::string with_groups =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 7 \"Top A\"\n3 9 \"reservoir\"\n$EndPhysicalNames\n"
    "$Entities\n1 1 2 1\n1 0 0 0 0\n5 0 0 0 1 0 0 0 2 1 -2\n1 0 0 0 1 1 0 1 7 0\n2 0 0 0 1 1 0 1 7 0\n4 0 0 0 1 1 1 1 "
    "9 2 1 2\n$EndEntities\n"
    "$Nodes\n1 4 10 40\n3 4 0 4\n10\n20\n30\n40\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n"
    "$Elements\n5 6 1 6\n0 1 15 1\n1 10\n1 5 1 2\n2 10 20\n3 20 30\n2 1 2 1\n4 10 30 20\n2 2 2 1\n5 10 20 40\n3 4 4 "
    "1\n6 10 20 30 40\n$EndElements\n"
    "$Periodic\n0\n$EndPeriodic\n";

TEST(ReadGmsh, a_patch_is_an_elementary_surface_and_its_entity_the_physical_group) {
  const InputData input = read_whole(read_gmsh, with_groups, "a.msh");
  EXPECT_EQ(input.surfaces.patch_entity, (std::vector<std::uint32_t>{0, 0}));
  EXPECT_EQ(input.surfaces.entities.at(0).name, "Top A");
  EXPECT_EQ(input.volume.region_names, (std::vector<std::string>{"reservoir"}));
  EXPECT_EQ(input.volume.cell_vertices, (std::vector<std::uint32_t>{0, 1, 2, 3})) << "node numbers have gaps";
  ASSERT_EQ(input.lines.size(), 1u);
  EXPECT_EQ(input.lines[0].points.size(), 3u);
  EXPECT_EQ(input.lines[0].name, "a_5");
  ASSERT_EQ(input.warnings.size(), 1u);
  EXPECT_NE(input.warnings[0].what.find("$Periodic"), std::string::npos);
}

TEST(ReadGmsh, crlf_reads_like_lf) {
  EXPECT_EQ(archived(read_whole(read_gmsh, with_crlf(with_groups), "a.msh")),
            archived(read_whole(read_gmsh, with_groups, "a.msh")));
}

TEST(ReadGmsh, names_what_is_wrong) {
  expect_malformed(read_gmsh(replaced(with_groups, "0 0 1\n$EndNodes", "0 0 nan\n$EndNodes"), "a.msh"),
                   "node 40 has a coordinate that is not a finite number", "a.msh");
  expect_malformed(read_gmsh(replaced(with_groups, "6 10 20 30 40", "6 10 20 30 41"), "a.msh"),
                   "node 41 does not exist", "a.msh");
  expect_malformed(read_gmsh(replaced(with_groups, "\n20\n", "\n10\n"), "a.msh"), "two nodes have the same number",
                   "a.msh");
  expect_malformed(read_gmsh(replaced(with_groups, "3 4 0 4", "3 4 0 4000000000000"), "a.msh"),
                   "which this file cannot hold", "a.msh");
  expect_malformed(read_gmsh(replaced(with_groups, "3 4 4 1", "3 4 99 1"), "a.msh"), "unknown element type 99",
                   "a.msh");
  expect_malformed(read_gmsh(replaced(with_groups, "$MeshFormat", "$MashFormat"), "a.msh"),
                   "does not start with $MeshFormat", "a.msh");
  expect_malformed(read_gmsh("", "a.msh"), "does not start with $MeshFormat", "a.msh");
  const Result<InputData> other = read_gmsh(replaced(with_groups, "4.1", "4.0"), "a.msh");
  ASSERT_FALSE(other);
  EXPECT_EQ(other.failure().code, FailureCode::unsupported);
}

TEST(ReadGmsh, survives_damage) {
  for (const char* name : {"gmsh/v22_ascii.msh", "gmsh/v22_binary.msh", "gmsh/v41_ascii.msh", "gmsh/v41_binary.msh"}) {
    expect_truncation_is_named(read_gmsh, text_of(own_sample(name)), name);
    expect_damage_is_survived(read_gmsh, text_of(own_sample(name)), name);
  }
}

}  // namespace
}  // namespace strataflow
