#include "kernels/hexes/extrusion/wall_faces.h"

#include <gtest/gtest.h>

#include "kernels/hexes/tet_models.h"

namespace strataflow {
namespace {

TEST(WallFaces, are_those_of_faults_and_sides_of_the_model) {
  const LayeredSpace space = support::upright(support::filled(*vertical_faults(1, false), 130), {1, {}, {}});
  const std::vector<std::uint32_t> walls = walls_of_faces(space);
  std::size_t on_fault = 0;
  for (std::uint32_t face = 0; face < walls.size(); ++face) {
    ASSERT_EQ(walls[face] != no_index, space.model.is_wall(face));
    on_fault += walls[face] != no_index && space.model.entities[walls[face]].name == "F1" ? 1 : 0;
  }
  std::size_t facets = 0;
  for (const SheetFacet& facet : space.model.facets) facets += facet.kind == SheetKind::fault ? 1 : 0;
  EXPECT_EQ(on_fault, 2 * facets);
}

TEST(WallFaces, go_on_through_tetrahedra_without_volume) {
  const LayeredSpace space = support::upright(support::filled(*unconformity(true), 100), {1, {}, {}});
  ASSERT_GT(space.layers.tets.size(), space.layers.model_tets);
  const std::vector<std::uint32_t> walls = walls_of_faces(space);
  std::set<std::string> names;
  for (std::uint32_t face = 4 * space.layers.model_tets; face < walls.size(); ++face)
    if (walls[face] != no_index) names.insert(space.model.entities[walls[face]].name);
  EXPECT_EQ(names, (std::set<std::string>{"East", "F1", "North", "South"}));
}

}  // namespace
}  // namespace strataflow
