#include "io/vtk/read_vtk_xml.h"

#include "io/mesh_samples.h"

namespace strataflow {
namespace {
using namespace support;

const char* const variants[] = {"ascii",
                                "base64",
                                "base64_zlib_64",
                                "raw_64",
                                "raw_zlib",
                                "appended_base64",
                                "appended_base64_zlib_big_endian",
                                "raw_big_endian_64"};

TEST(ReadVtkXml, every_encoding_of_vtk_holds_the_same) {
  const InputData ascii = read_whole(read_vtk_xml, text_of(own_sample("vtk_xml/ascii.vtp")), "a.vtp");
  EXPECT_EQ(ascii.surfaces.points.size(), 12u);
  EXPECT_EQ(ascii.surfaces.triangles,
            (std::vector<Triangle>{{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}, {4, 5, 7}, {7, 5, 6}}));
  EXPECT_EQ(ascii.surfaces.triangle_patch, (std::vector<std::uint32_t>{0, 0, 1, 1, 2, 2}));
  EXPECT_EQ(ascii.surfaces.patch_entity, (std::vector<std::uint32_t>{0, 1, 1}));
  ASSERT_EQ(ascii.surfaces.entities.size(), 2u);
  EXPECT_EQ(ascii.surfaces.entities[0].name, "Top A");
  EXPECT_EQ(ascii.surfaces.entities[1].name, "faille \xc3\xa9");
  EXPECT_EQ(ascii.lines.size(), 1u);
  for (const char* name : variants) {
    InputData other = read_whole(read_vtk_xml, text_of(own_sample("vtk_xml/" + std::string(name) + ".vtp")), "a.vtp");
    for (std::size_t i = 0; i < 12; ++i)
      EXPECT_NEAR(other.surfaces.properties.at(0).values[i], 0.1 * static_cast<double>(i), 1e-9) << name;
    other.surfaces.properties = ascii.surfaces.properties;  // ascii VTK files round
    EXPECT_EQ(archived(other), archived(ascii)) << name;
  }
}

TEST(ReadVtkXml, reads_grids_of_all_cell_types) {
  expect_the_mixed_mesh(read_whole(read_vtk_xml, text_of(own_sample("vtk_xml/meshio.vtu")), "a.vtu"));
}

const std::string two_pieces =
    "<VTKFile type=\"PolyData\"><PolyData>"
    "<Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" "
    "format=\"ascii\">0 0 0 1 0 0 0 1 0</DataArray></Points>"
    "<Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2</DataArray><DataArray "
    "type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys></Piece>\n"
    "<Piece NumberOfPoints=\"3\" NumberOfPolys=\"1\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\" "
    "format=\"ascii\">0 0 1 1 0 1 0 1 1</DataArray></Points>"
    "<Polys><DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 2 1</DataArray><DataArray "
    "type=\"Int32\" Name=\"offsets\" format=\"ascii\">3</DataArray></Polys></Piece>\n"
    "</PolyData></VTKFile>\n";

TEST(ReadVtkXml, pieces_follow_one_another) {
  const InputData input = read_whole(read_vtk_xml, two_pieces, "dfn.vtp");
  EXPECT_EQ(input.surfaces.triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 5, 4}}));
  EXPECT_EQ(input.surfaces.entities.at(0).name, "dfn");
}

TEST(ReadVtkXml, crlf_reads_like_lf) {
  EXPECT_EQ(archived(read_whole(read_vtk_xml, with_crlf(two_pieces), "a.vtp")),
            archived(read_whole(read_vtk_xml, two_pieces, "a.vtp")));
}

TEST(ReadVtkXml, names_what_is_wrong) {
  expect_malformed(read_vtk_xml(replaced(two_pieces, "1 0 0 0 1 0", "1 0 0 nan 1 0"), "a.vtp"),
                   "point 3 has a coordinate that is not a finite number", "a.vtp");
  expect_malformed(read_vtk_xml(replaced(two_pieces, ">0 1 2<", ">0 1 3<"), "a.vtp"),
                   "refers to point 3; points go from 0 to 2", "a.vtp");
  expect_malformed(read_vtk_xml(replaced(two_pieces, ">3<", ">4<"), "a.vtp"),
                   "offset 4 is out of order or behind the end", "a.vtp");
  expect_malformed(read_vtk_xml(replaced(two_pieces, "NumberOfPoints=\"3\"", "NumberOfPoints=\"4000000000\""), "a.vtp"),
                   "says it has 4000000000 points, holds 3", "a.vtp");
  expect_malformed(read_vtk_xml(replaced(two_pieces, "<VTKFile", "<VTXFile"), "a.vtp"), "not a VTK XML file", "a.vtp");
  expect_malformed(read_vtk_xml("", "a.vtp"), "the file is empty", "a.vtp");
  expect_malformed(read_vtk_xml("solid a", "a.vtp"), "not a VTK XML file", "a.vtp");
  expect_malformed(read_vtk_xml("solid a\n" + two_pieces, "a.vtp"), "does not start with '<'", "a.vtp");
  const Result<InputData> image = read_vtk_xml("<VTKFile type=\"ImageData\"/>", "a.vti");
  ASSERT_FALSE(image);
  EXPECT_EQ(image.failure().code, FailureCode::unsupported);
  const Result<InputData> lz4 =
      read_vtk_xml("<VTKFile type=\"PolyData\" compressor=\"vtkLZ4DataCompressor\"/>", "a.vtp");
  ASSERT_FALSE(lz4);
  EXPECT_EQ(lz4.failure().code, FailureCode::unsupported);
}

TEST(ReadVtkXml, survives_damage) {
  for (const char* name : variants) {
    const std::string bytes = text_of(own_sample("vtk_xml/" + std::string(name) + ".vtp"));
    // Cut inside the appended data, a file is refused only by the array that is no longer whole.
    expect_truncation_is_named(read_vtk_xml, bytes, "a.vtp");
    expect_damage_is_survived(read_vtk_xml, bytes, "a.vtp");
  }
  expect_truncation_is_named(read_vtk_xml, text_of(own_sample("vtk_xml/meshio.vtu")), "a.vtu");
  expect_damage_is_survived(read_vtk_xml, text_of(own_sample("vtk_xml/meshio.vtu")), "a.vtu");
}

TEST(ReadVtkXml, reads_the_fracture_networks) {
  STRATAFLOW_NEEDS_SHARED_DATA();
  const InputData first = read_whole(read_vtk_xml, text_of(shared_data() / "dfn/dfn1_ascii.vtp"), "dfn1_ascii.vtp");
  EXPECT_EQ(first.surfaces.points.size(), 187u);
  EXPECT_EQ(first.surfaces.triangles.size(), 187u - 2 * 10) << "10 polygons, fanned";
  EXPECT_EQ(first.surfaces.properties.at(0).name, "FractureSize");
  const InputData second =
      read_whole(read_vtk_xml, text_of(shared_data() / "dfn/dfn2_mesh_compressed.vtp"), "dfn2_mesh_compressed.vtp");
  EXPECT_EQ(second.surfaces.points.size(), 33413u);
  EXPECT_EQ(second.surfaces.triangles.size(), 58820u);
}

}  // namespace
}  // namespace strataflow
