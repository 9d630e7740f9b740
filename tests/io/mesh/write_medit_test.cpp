#include "io/mesh/write_medit.h"

#include "io/mesh/read_medit.h"
#include "io/mesh_samples.h"

namespace strataflow {
namespace {
using namespace support;

TEST(WriteMedit, volumes_come_back_with_regions_and_exact_coordinates) {
  const VolumeMesh mesh = two_region_mesh();
  const InputData again = read_whole(read_medit, write_medit(mesh), "a.mesh");
  ASSERT_EQ(again.volume.points.size(), mesh.points.size());
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    EXPECT_EQ(again.volume.points[i], mesh.points[i] + mesh.local_origin);
  EXPECT_EQ(again.volume.cell_types, mesh.cell_types);
  EXPECT_EQ(again.volume.cell_vertices, mesh.cell_vertices);
  EXPECT_EQ(again.volume.cell_region, mesh.cell_region);
  EXPECT_EQ(again.surfaces.triangles.size(), 4u);
  EXPECT_EQ(again.surfaces.triangle_patch, (std::vector<std::uint32_t>{0, 0, 1, 1}));
}

TEST(WriteMedit, surfaces_come_back_with_their_references) {
  const TriangleSoup soup = two_surface_soup();
  const InputData again = read_whole(read_medit, write_medit(labelled_triangles(soup)), "a.mesh");
  EXPECT_EQ(archived(again.surfaces.points), archived(in_world_coordinates(soup).points));
  EXPECT_EQ(again.surfaces.triangles, soup.triangles);
  EXPECT_EQ(again.surfaces.triangle_patch, soup.triangle_patch);
  EXPECT_EQ(again.surfaces.entities.at(2).name, "a_3");
}

}  // namespace
}  // namespace strataflow
