#include "io/vtk/read_vtk_legacy.h"

#include "io/mesh_samples.h"

namespace strataflow {
namespace {
using namespace support;

TEST(ReadVtkLegacy, grids_of_both_generations_and_encodings_hold_the_same) {
  const InputData first = read_whole(read_vtk_legacy, text_of(own_sample("vtk_legacy/grid_42_ascii.vtk")), "a.vtk");
  expect_the_mixed_mesh(first);
  for (const char* name : {"grid_42_binary", "grid_51_ascii", "grid_51_binary"})
    EXPECT_EQ(
        archived(read_whole(read_vtk_legacy, text_of(own_sample("vtk_legacy/" + std::string(name) + ".vtk")), "a.vtk")),
        archived(first))
        << name;
}

TEST(ReadVtkLegacy, poly_data_have_patches_lines_strips_and_properties) {
  const InputData ascii = read_whole(read_vtk_legacy, text_of(own_sample("vtk_legacy/poly_ascii.vtk")), "a.vtk");
  EXPECT_EQ(ascii.surfaces.points.size(), 12u);
  EXPECT_EQ(ascii.surfaces.triangles,
            (std::vector<Triangle>{{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}, {4, 5, 7}, {7, 5, 6}}));
  EXPECT_EQ(ascii.surfaces.triangle_patch, (std::vector<std::uint32_t>{0, 0, 1, 1, 2, 2}));
  EXPECT_EQ(ascii.surfaces.patch_entity, (std::vector<std::uint32_t>{0, 1, 1}));
  EXPECT_EQ(ascii.lines.size(), 1u);
  ASSERT_EQ(ascii.surfaces.properties.size(), 1u);
  EXPECT_EQ(ascii.surfaces.properties[0].name, "porosity");
  InputData binary = read_whole(read_vtk_legacy, text_of(own_sample("vtk_legacy/poly_binary.vtk")), "a.vtk");
  for (std::size_t i = 0; i < 12; ++i)
    EXPECT_NEAR(binary.surfaces.properties.at(0).values[i], ascii.surfaces.properties[0].values[i], 1e-9);
  binary.surfaces.properties = ascii.surfaces.properties;  // ascii VTK files round
  EXPECT_EQ(archived(binary), archived(ascii));
}

const std::string small =
    "# vtk DataFile Version 2.0\ntitle\nASCII\nDATASET POLYDATA\nPOINTS 4 float\n0 0 0 1 0 0\n1 1 0 0 1 0\nPOLYGONS 1 "
    "5\n4 0 1 2 3\n"
    "CELL_DATA 1\nSCALARS colour int 1\nLOOKUP_TABLE default\n3\nPOINT_DATA 4\nVECTORS v float\n1 2 3 1 2 3 1 2 3 1 2 "
    "3\nFIELD more 1\np 1 4 double\n1 2 3 4\n";

TEST(ReadVtkLegacy, takes_vectors_and_fields_and_names_what_it_leaves_aside) {
  const InputData input = read_whole(read_vtk_legacy, small, "a.vtk");
  ASSERT_EQ(input.surfaces.properties.size(), 2u);
  EXPECT_EQ(input.surfaces.properties[0].width, 3u);
  EXPECT_EQ(input.surfaces.properties[1].values, (std::vector<double>{1, 2, 3, 4}));
  ASSERT_EQ(input.warnings.size(), 1u);
  EXPECT_NE(input.warnings[0].what.find("'colour'"), std::string::npos);
}

TEST(ReadVtkLegacy, crlf_reads_like_lf) {
  EXPECT_EQ(archived(read_whole(read_vtk_legacy, with_crlf(small), "a.vtk")),
            archived(read_whole(read_vtk_legacy, small, "a.vtk")));
}

TEST(ReadVtkLegacy, names_what_is_wrong) {
  expect_malformed(read_vtk_legacy(replaced(small, "1 1 0 0 1 0", "1 1 0 0 nan 0"), "a.vtk"),
                   "point 4 has a coordinate that is not a finite number", "a.vtk");
  expect_malformed(read_vtk_legacy(replaced(small, "4 0 1 2 3", "4 0 1 2 4"), "a.vtk"),
                   "refers to point 4; points go from 0 to 3", "a.vtk");
  expect_malformed(read_vtk_legacy(replaced(small, "4 0 1 2 3", "5 0 1 2 3"), "a.vtk"), "longer than the list",
                   "a.vtk");
  expect_malformed(read_vtk_legacy(replaced(small, "POINTS 4", "POINTS 4000000000000"), "a.vtk"),
                   "which this file cannot hold", "a.vtk");
  expect_malformed(read_vtk_legacy(replaced(small, "# vtk", "# vtx"), "a.vtk"), "does not start with '# vtk DataFile'",
                   "a.vtk");
  expect_malformed(read_vtk_legacy(replaced(small, "ASCII", "ASKII"), "a.vtk"), "expected ASCII or BINARY", "a.vtk");
  expect_malformed(read_vtk_legacy("", "a.vtk"), "does not start with '# vtk DataFile'", "a.vtk");
  const Result<InputData> grid = read_vtk_legacy(replaced(small, "POLYDATA", "STRUCTURED_GRID"), "a.vtk");
  ASSERT_FALSE(grid);
  EXPECT_EQ(grid.failure().code, FailureCode::unsupported);
}

TEST(ReadVtkLegacy, survives_damage) {
  for (const char* name :
       {"grid_42_ascii", "grid_42_binary", "grid_51_ascii", "grid_51_binary", "poly_ascii", "poly_binary"}) {
    const std::string bytes = text_of(own_sample("vtk_legacy/" + std::string(name) + ".vtk"));
    expect_truncation_is_named(read_vtk_legacy, bytes, "a.vtk", true);  // a file may end between two sections
    expect_damage_is_survived(read_vtk_legacy, bytes, "a.vtk");
  }
}

}  // namespace
}  // namespace strataflow
