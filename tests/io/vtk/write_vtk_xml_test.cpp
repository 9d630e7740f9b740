#include "io/vtk/write_vtk_xml.h"

#include "io/mesh_samples.h"
#include "io/vtk/read_vtk_xml.h"

namespace strataflow {
namespace {
using namespace support;

TEST(WriteVtkXml, surfaces_come_back_bit_for_bit) {
  const TriangleSoup soup = two_surface_soup();
  const InputData again = read_whole(read_vtk_xml, write_vtp(labelled_triangles(soup)), "a.vtp");
  EXPECT_EQ(archived(again.surfaces), archived(in_world_coordinates(soup)));
}

TEST(WriteVtkXml, volumes_come_back_bit_for_bit) {
  VolumeMesh mesh = two_region_mesh();
  mesh.cell_entity = {0, 1, 0, 0, 1};
  VolumeMesh again = read_whole(read_vtk_xml, write_vtu(mesh), "a.vtu").volume;
  for (Vec3& point : mesh.points) point = point + mesh.local_origin;
  mesh.local_origin = {};
  mesh.facets.clear();
  mesh.surface_entity.clear();
  for (Entity& entity : mesh.entities) entity.role = Role::unknown;  // a .vtu names entities, not their roles
  EXPECT_EQ(archived(again), archived(mesh));
}

TEST(WriteVtkXml, cells_carry_further_fields_of_the_right_length) {
  const VolumeMesh mesh = two_region_mesh();
  const std::vector<CellField> fields{{"elements", {1, 2, 3, 4, 5}}, {"torn", {1}}};
  const std::string bytes = write_vtu(mesh, fields);
  EXPECT_NE(bytes.find("\"elements\""), std::string::npos);
  EXPECT_EQ(bytes.find("\"torn\""), std::string::npos);
  EXPECT_EQ(write_vtu(mesh), write_vtu(mesh, {}));
}

TEST(WriteVtkXml, facets_are_polygons_with_the_points_of_the_mesh) {
  const VolumeMesh mesh = two_region_mesh();
  const std::string bytes = write_facets_vtp(mesh);
  const InputData again = read_whole(read_vtk_xml, bytes, "a.vtp");
  EXPECT_EQ(again.surfaces.points.size(), mesh.points.size());
  EXPECT_EQ(again.surfaces.triangles.size(), 4u) << "two triangles and a quad";
  EXPECT_EQ(again.surfaces.entities.at(1).name, "Top \xc3\xa9");
  EXPECT_EQ(again.surfaces.entities.at(1).role, Role::horizon);
  for (const char* name : {"\"cell_0\"", "\"cell_1\"", "\"line\"", "\"corner\""})
    EXPECT_NE(bytes.find(name), std::string::npos) << name;
}

TEST(WriteVtkXml, quads_come_with_a_line_for_every_edge_on_a_feature) {
  QuadMesh mesh;
  mesh.local_origin = {100, 0, 0};
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}};
  mesh.quads = {{0, 1, 4, 3}, {1, 2, 5, 4}};
  mesh.features = {{.name = "F1", .role = Role::fault}};
  mesh.edges = {{1, 4, 0}};
  const std::string bytes = write_quads_vtp(mesh);
  const InputData again = read_whole(read_vtk_xml, bytes, "a.vtp");
  EXPECT_EQ(again.surfaces.triangles.size(), 4u);
  ASSERT_EQ(again.lines.size(), 1u);
  EXPECT_EQ(again.lines[0].points, (std::vector<Vec3>{{101, 0, 0}, {101, 1, 0}}));
  for (const char* name : {"\"feature\"", "\"feature_names\"", "\"feature_roles\""})
    EXPECT_NE(bytes.find(name), std::string::npos) << name;
}

TEST(WriteVtkXml, lines_come_back_as_lines) {
  const std::vector<Polyline> lines{{"a", Role::curve, {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}}, false},
                                    {"b", Role::curve, {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}}, true}};
  const InputData again = read_whole(read_vtk_xml, write_lines_vtp(lines, {10, 0, 0}), "a.vtp");
  ASSERT_EQ(again.lines.size(), 2u);
  EXPECT_EQ(again.lines[0].points, (std::vector<Vec3>{{10, 0, 0}, {11, 0, 0}, {12, 1, 0}}));
  EXPECT_NE(write_lines_vtp({}, {}).find("NumberOfLines=\"0\""), std::string::npos);
}

TEST(WriteVtkXml, a_plan_carries_its_field_and_its_map) {
  FeatureMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.features = {{.name = "F1", .role = Role::fault}};
  mesh.edges = {{0, 2, 0}};
  mesh.corners = {0};
  const InputData plain = read_whole(read_vtk_xml, write_feature_mesh_vtp(mesh, nullptr, nullptr), "a.vtp");
  EXPECT_EQ(plain.surfaces.points.size(), 4u);
  EXPECT_EQ(plain.surfaces.triangles.size(), 2u);
  EXPECT_EQ(plain.lines.size(), 1u);
  FrameField field;
  field.angles = {{0, 1.5}, {0, 1.5}};
  field.valence = {2, 2, 2, 2};
  CornerMap map;
  map.uv = {{0, 0}, {2, 0}, {2, 2}, {0, 0}, {2, 2}, {0, 2}};
  map.valence = field.valence;
  const std::string bytes = write_feature_mesh_vtp(mesh, &field, &map);
  const InputData mapped = read_whole(read_vtk_xml, bytes, "a.vtp");
  EXPECT_EQ(mapped.surfaces.triangles.size(), 2u);
  for (const char* name : {"\"u\"", "\"v\"", "\"valence\"", "\"corner\"", "\"direction_0\"", "\"direction_1\"", "\"feature\""})
    EXPECT_NE(bytes.find(name), std::string::npos) << name;
}

TEST(WriteVtkXml, the_same_content_gives_the_same_bytes) {
  EXPECT_EQ(write_vtu(two_region_mesh()), write_vtu(two_region_mesh()));
  const TriangleSoup soup = two_surface_soup();
  EXPECT_EQ(write_vtp(labelled_triangles(soup)), write_vtp(labelled_triangles(soup)));
}

TEST(WriteVtkXml, an_empty_mesh_is_a_whole_file) {
  const std::string bytes = write_vtu(VolumeMesh{});
  EXPECT_NE(bytes.find("NumberOfCells=\"0\""), std::string::npos);
  EXPECT_EQ(bytes.substr(bytes.size() - 11), "</VTKFile>\n");
}

TEST(WriteVtkXml, a_property_name_that_xml_cannot_hold_is_replaced) {
  TriangleSoup soup = two_surface_soup();
  soup.properties[0].name = "a<b>&\"\xff\x01";
  const InputData again = read_whole(read_vtk_xml, write_vtp(labelled_triangles(soup)), "a.vtp");
  EXPECT_EQ(again.surfaces.properties.at(0).name, "a<b>&\"__");
}

}  // namespace
}  // namespace strataflow
