#include "io/mesh/read_ucd.h"

#include "io/mesh_samples.h"

namespace strataflow {
namespace {
using namespace support;

TEST(ReadUcd, materials_are_patches_and_regions_and_cells_are_turned_right_way_up) {
  const InputData input = read_whole(read_ucd, text_of(own_sample("ucd/mixed.inp")), "mixed.inp");
  expect_the_mixed_mesh(input);
  EXPECT_EQ(input.volume.region_names, (std::vector<std::string>{"mixed_1", "mixed_2"}));
  EXPECT_EQ(input.surfaces.triangle_patch, (std::vector<std::uint32_t>{0, 0, 1, 1}));
}

const std::string with_values =
    "3 2 2 1 0\n4 0 0 0\n7 1 0 0\n9 0 1 0\n1 1 tri 4 7 9\n2 1 line 4 7\n2 1 1\nimt1, integer\npor, fraction\n4 1 "
    "0.5\n7 1 0.25\n9 2 0.125\n1 1\nc, none\n1 0\n2 0\n";

TEST(ReadUcd, node_values_become_properties_with_units) {
  const InputData input = read_whole(read_ucd, with_values, "a.inp");
  ASSERT_EQ(input.surfaces.properties.size(), 2u);
  EXPECT_EQ(input.surfaces.properties[1].name, "por");
  EXPECT_EQ(input.surfaces.properties[1].unit, "fraction");
  EXPECT_EQ(input.surfaces.properties[1].values, (std::vector<double>{0.5, 0.25, 0.125}));
  EXPECT_EQ(input.lines.size(), 1u);
  ASSERT_EQ(input.warnings.size(), 1u);
  EXPECT_EQ(input.warnings[0].kind, "ignored_cell_data");
}

TEST(ReadUcd, crlf_reads_like_lf) {
  EXPECT_EQ(archived(read_whole(read_ucd, with_crlf(with_values), "a.inp")),
            archived(read_whole(read_ucd, with_values, "a.inp")));
}

TEST(ReadUcd, names_the_line_of_what_is_wrong) {
  expect_malformed(read_ucd(replaced(with_values, "7 1 0 0", "7 1 nan 0"), "a.inp"),
                   "a.inp:3: a coordinate is not a finite number", "a.inp");
  expect_malformed(read_ucd(replaced(with_values, "tri 4 7 9", "tri 4 7 8"), "a.inp"), "node 8 does not exist",
                   "a.inp");
  expect_malformed(read_ucd(replaced(with_values, "7 1 0 0", "4 1 0 0"), "a.inp"), "two nodes have the same number",
                   "a.inp");
  expect_malformed(read_ucd(replaced(with_values, "tri", "trj"), "a.inp"), "unknown kind of cell 'trj'", "a.inp");
  expect_malformed(read_ucd(replaced(with_values, "3 2 2 1 0", "3 2000000000 2 1 0"), "a.inp"),
                   "which this file cannot hold", "a.inp");
  expect_malformed(read_ucd("", "a.inp"), "the file ends where the number of nodes should be", "a.inp");
  expect_malformed(read_ucd("hello", "a.inp"), "expected the number of nodes, found 'hello'", "a.inp");
  const Result<InputData> abaqus = read_ucd("*HEADING\n*NODE\n", "a.inp");
  ASSERT_FALSE(abaqus);
  EXPECT_EQ(abaqus.failure().code, FailureCode::unsupported);
  EXPECT_NE(abaqus.failure().what.find("Abaqus"), std::string::npos);
}

TEST(ReadUcd, survives_damage) {
  expect_truncation_is_named(read_ucd, text_of(own_sample("ucd/mixed.inp")), "a.inp");
  expect_damage_is_survived(read_ucd, text_of(own_sample("ucd/mixed.inp")), "a.inp");
  expect_damage_is_survived(read_ucd, with_values, "a.inp");
}

TEST(ReadUcd, reads_the_fracture_network_of_lagrit) {
  STRATAFLOW_NEEDS_SHARED_DATA();
  const InputData input = read_whole(read_ucd, text_of(shared_data() / "dfn/lagrit_tri_dfn.inp"), "lagrit_tri_dfn.inp");
  EXPECT_EQ(input.surfaces.points.size(), 2956u);
  EXPECT_EQ(input.surfaces.triangles.size(), 5773u);
  EXPECT_EQ(input.surfaces.properties.size(), 7u);
}

}  // namespace
}  // namespace strataflow
