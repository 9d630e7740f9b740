#include "kernels/hexes/labelled_tets.h"

#include <gtest/gtest.h>

#include "kernels/hexes/tet_models.h"

namespace strataflow {
namespace {

TEST(LabelledTets, know_top_bottom_sides_horizons_and_faults) {
  const VolumeMesh mesh = support::filled(*vertical_faults(1, false), 150);
  const Result<LabelledTets> tets = label_tets(mesh);
  ASSERT_TRUE(tets);
  for (const SheetFacet& facet : tets->facets) {
    const std::string& name = tets->entities[facet.entity].name;
    const SheetKind expected = name == "Top"      ? SheetKind::top
                               : name == "Bottom" ? SheetKind::bottom
                               : name[0] == 'H'   ? SheetKind::horizon
                               : name == "F1"     ? SheetKind::fault
                                                  : SheetKind::side;
    ASSERT_EQ(facet.kind, expected) << name;
  }
  for (std::uint32_t face = 0; face < tets->neighbour.size(); ++face) {
    const std::uint32_t other = tets->neighbour[face];
    if (other == no_index) continue;
    ASSERT_EQ(tets->neighbour[other], face);
    ASSERT_EQ(tets->facet_of[other], tets->facet_of[face]);
  }
}

TEST(LabelledTets, let_dropped_faults_displace_but_not_be_followed) {
  const VolumeMesh mesh = support::filled(*vertical_faults(1, false), 150);
  const Result<LabelledTets> tets = label_tets(mesh, {"F1"});
  ASSERT_TRUE(tets);
  bool has_fault = false;
  for (std::uint32_t face = 0; face < tets->facet_of.size(); ++face)
    if (tets->has(face, SheetKind::fault)) {
      has_fault = true;
      EXPECT_FALSE(tets->is_wall(face));
    }
  EXPECT_TRUE(has_fault);
}

TEST(LabelledTets, refuse_what_cannot_be_extruded_by_name) {
  VolumeMesh mesh = support::filled(*vertical_faults(1, false), 150);
  EXPECT_EQ(label_tets(mesh, {"F9"}).failure().code, FailureCode::invalid_options);
  for (Entity& entity : mesh.entities)
    if (entity.name == "F1") entity.role = Role::intrusion;
  const Result<LabelledTets> refused = label_tets(mesh);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.failure().code, FailureCode::unsupported);
  EXPECT_NE(refused.failure().what.find("F1"), std::string::npos);
  EXPECT_NE(refused.failure().remedy.find("drop_alignment"), std::string::npos);
  EXPECT_TRUE(label_tets(mesh, {"F1"}));
}

TEST(LabelledTets, refuse_meshes_that_do_not_conform) {
  VolumeMesh mesh = support::filled(*vertical_faults(0, false), 150);
  VolumeMesh flipped = mesh;
  std::swap(flipped.cell_vertices[0], flipped.cell_vertices[1]);
  EXPECT_FALSE(label_tets(flipped));
  VolumeMesh open = mesh;
  open.facets.clear();
  EXPECT_FALSE(label_tets(open));
  EXPECT_FALSE(label_tets(VolumeMesh{}));
}

}  // namespace
}  // namespace strataflow
