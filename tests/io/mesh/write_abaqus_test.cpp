#include "io/mesh/write_abaqus.h"

#include "io/mesh_samples.h"

namespace strataflow {
namespace {
using namespace support;

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t place = text.find(word); place != std::string::npos; place = text.find(word, place + 1)) ++count;
  return count;
}

TEST(WriteAbaqus, a_volume_has_solids_by_region_and_node_sets_by_surface) {
  const std::string text = write_abaqus(two_region_mesh());
  for (const char* block :
       {"*ELEMENT, TYPE=C3D4, ELSET=upper\n1, 4, 7, 3, 12\n2, 4, 8, 7, 12\n",
        "*ELEMENT, TYPE=C3D5, ELSET=lower\n3, 5, 6, 7, 8, 9\n",
        "*ELEMENT, TYPE=C3D6, ELSET=upper\n4, 2, 6, 10, 3, 7, 11\n",
        "*ELEMENT, TYPE=C3D8, ELSET=lower\n5, 1, 2, 3, 4, 5, 6, 7, 8\n", "*NSET, NSET=F1\n1, 2, 3, 4\n",
        "*NSET, NSET=Top___\n5, 6, 7, 8\n", "*NSET, NSET=lower\n", "1, 5e+05, 6e+06, -1000\n"})
    EXPECT_NE(text.find(block), std::string::npos) << block << "\nis not in\n" << text;
  EXPECT_EQ(count_of(text, "S3"), 0u) << "no shells beside solids";
}

TEST(WriteAbaqus, surfaces_alone_are_shells) {
  const TriangleSoup soup = two_surface_soup();
  const std::string text = write_abaqus(labelled_triangles(soup));
  EXPECT_NE(text.find("*ELEMENT, TYPE=S3, ELSET=F1_1\n1, 1, 2, 3\n"), std::string::npos) << text;
  EXPECT_NE(text.find("*ELEMENT, TYPE=S3, ELSET=Top\n3, 2, 5, 4\n"), std::string::npos) << text;
  EXPECT_NE(text.find("3, 5e+05, 6000001, 12345.678901234567\n"), std::string::npos) << text;
}

TEST(WriteAbaqus, set_names_start_with_a_letter_and_do_not_collide) {
  TriangleSoup soup = two_surface_soup();
  soup.entities[0].name = soup.entities[1].name = "1 fault";
  const std::string text = write_abaqus(labelled_triangles(soup));
  EXPECT_EQ(count_of(text, "ELSET=S_1_fault_1\n"), 1u) << text;
  EXPECT_EQ(count_of(text, "ELSET=S_1_fault\n"), 1u) << text;
}

TEST(WriteAbaqus, node_sets_have_sixteen_numbers_a_line_at_most) {
  VolumeMesh mesh;
  for (int i = 0; i < 40; ++i) mesh.points.push_back({double(i), double(i % 3), double(i % 5)});
  for (std::uint32_t i = 0; i + 3 < 40; ++i) {
    const std::uint32_t tet[] = {i, i + 1, i + 2, i + 3};
    mesh.add_cell(CellType::tetrahedron, tet, 0);
  }
  const std::string text = write_abaqus(mesh);
  const std::string set = text.substr(text.find("*NSET"));
  EXPECT_EQ(count_of(set, "\n"), 4u) << set;
}

}  // namespace
}  // namespace strataflow
