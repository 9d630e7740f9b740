#include "io/input/labelled_triangles.h"

#include "io/mesh_samples.h"

namespace strataflow {
namespace {
using namespace support;

TEST(LabelledTriangles, an_entity_with_several_surfaces_numbers_them) {
  const std::vector<std::uint32_t> surface_entity{0, 0, 1};
  const std::vector<Entity> entities{{"F 1", Role::fault}, {"Top", Role::horizon}};
  EXPECT_EQ(surface_names(surface_entity, entities), (std::vector<std::string>{"F_1_1", "F_1_2", "Top"}));
}

TEST(LabelledTriangles, names_never_collide) {
  const std::vector<std::uint32_t> surface_entity{0, 1, 2};
  const std::vector<Entity> entities{{"a b", Role::fault}, {"a_b", Role::fault}, {"", Role::fault}};
  EXPECT_EQ(surface_names(surface_entity, entities), (std::vector<std::string>{"a_b", "a_b_2", "_2"}));
}

TEST(LabelledTriangles, regions_without_a_name_get_one) {
  VolumeMesh mesh;
  mesh.region_names = {"", "upper"};
  EXPECT_EQ(region_names(mesh, {0, 1, 2}), (std::vector<std::string>{"region_1", "upper", "region_3"}));
}

TEST(LabelledTriangles, regions_may_leave_gaps_and_cells_may_have_none) {
  VolumeMesh mesh;
  const std::uint32_t tet[] = {0, 1, 2, 3};
  for (const std::int32_t region : {2000000000, -1, 5}) mesh.add_cell(CellType::tetrahedron, tet, region);
  EXPECT_EQ(used_regions(mesh), (std::vector<std::int32_t>{5, 2000000000}));
  EXPECT_EQ(region_places(mesh, used_regions(mesh)), (std::vector<std::uint32_t>{1, 2, 0}));
}

TEST(LabelledTriangles, facets_keep_points_surfaces_and_labels) {
  const TriangleSoup soup = two_surface_soup();
  const VolumeMesh mesh = facets_only(labelled_triangles(soup));
  ASSERT_EQ(mesh.facets.size(), 3u);
  EXPECT_EQ(mesh.facets[2].surface, 2u);
  EXPECT_EQ(mesh.surface_entity, (std::vector<std::int32_t>{0, 0, 1}));
  EXPECT_EQ(mesh.points.size(), soup.points.size());
}

}  // namespace
}  // namespace strataflow
