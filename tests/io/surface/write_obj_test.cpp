#include "io/surface/write_obj.h"

#include "io/mesh_samples.h"
#include "io/surface/read_obj.h"

namespace strataflow {
namespace {
using namespace support;

TEST(WriteObj, surfaces_come_back_with_their_entities_and_exact_coordinates) {
  TriangleSoup soup = two_surface_soup();
  soup.properties.clear();
  const InputData again = read_whole(read_obj, write_obj(labelled_triangles(soup)), "a.obj");
  for (Entity& entity : soup.entities) entity.role = Role::unknown;  // OBJ has no word for roles
  EXPECT_EQ(archived(again.surfaces), archived(in_world_coordinates(soup)));
  EXPECT_TRUE(again.warnings.empty());
}

TEST(WriteObj, a_group_is_written_once_though_its_triangles_are_apart) {
  TriangleSoup soup = two_surface_soup();
  soup.triangle_patch = {2, 0, 2};
  const std::string text = write_obj(labelled_triangles(soup));
  EXPECT_EQ(text.find("g Top"), text.rfind("g Top"));
  EXPECT_EQ(read_whole(read_obj, text, "a.obj").surfaces.triangle_patch, (std::vector<std::uint32_t>{0, 1, 1}));
}

}  // namespace
}  // namespace strataflow
