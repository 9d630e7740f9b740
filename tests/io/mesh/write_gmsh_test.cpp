#include "io/mesh/write_gmsh.h"

#include "io/mesh/read_gmsh.h"
#include "io/mesh_samples.h"

namespace strataflow {
namespace {
using namespace support;

TEST(WriteGmsh, surfaces_come_back_with_their_entities_and_exact_coordinates) {
  TriangleSoup soup = two_surface_soup();
  soup.properties.clear();
  const InputData again = read_whole(read_gmsh, write_gmsh(labelled_triangles(soup)), "a.msh");
  for (Entity& entity : soup.entities) entity.role = Role::unknown;  // Gmsh has no word for roles
  EXPECT_EQ(archived(again.surfaces), archived(in_world_coordinates(soup)));
}

TEST(WriteGmsh, volumes_come_back_region_by_region) {
  const VolumeMesh mesh = two_region_mesh();
  const InputData again = read_whole(read_gmsh, write_gmsh(mesh), "a.msh");
  EXPECT_EQ(again.volume.region_names, mesh.region_names);
  EXPECT_EQ(again.volume.cell_region, (std::vector<std::int32_t>{0, 0, 1, 1, 1}));
  EXPECT_EQ(again.volume.cell_types,
            (std::vector<CellType>{CellType::hexahedron, CellType::pyramid, CellType::tetrahedron,
                                   CellType::tetrahedron, CellType::prism}));
  double before = 0, after = 0;
  for (std::size_t c = 0; c < 5; ++c) {
    before += cell_volume(mesh, c);
    VolumeMesh shifted = again.volume;
    for (Vec3& point : shifted.points) point = point - mesh.local_origin;
    EXPECT_GT(cell_volume(shifted, c), 0) << "cell " << c;
    after += cell_volume(shifted, c);
  }
  EXPECT_NEAR(after, before, 1e-12);
  EXPECT_EQ(again.surfaces.entities.at(0).name, "F1");
  EXPECT_EQ(again.surfaces.triangles.size(), 4u);
}

TEST(WriteGmsh, cells_without_a_region_are_in_no_group) {
  VolumeMesh mesh = two_region_mesh();
  mesh.cell_region.clear();
  const InputData again = read_whole(read_gmsh, write_gmsh(mesh), "a.msh");
  EXPECT_EQ(again.volume.region_names, (std::vector<std::string>{"a_1"}));
}

}  // namespace
}  // namespace strataflow
