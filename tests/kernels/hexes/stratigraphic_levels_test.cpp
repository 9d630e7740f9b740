#include "kernels/hexes/stratigraphic_levels.h"

#include <gtest/gtest.h>

#include "kernels/hexes/tet_models.h"
#include "kernels/reference_models/reference_plans.h"

namespace strataflow {
namespace {

Result<StratigraphicLevels> levels_of(const ColumnModel& columns, double edge_m) {
  const Result<LabelledTets> tets = label_tets(support::filled(columns, edge_m));
  if (!tets) return tets.failure();
  return find_stratigraphic_levels(*tets);
}

TEST(StratigraphicLevels, are_sorted_by_what_lies_over_what) {
  const Result<StratigraphicLevels> levels = levels_of(*unconformity(true), 120);
  ASSERT_TRUE(levels);
  EXPECT_EQ(levels->names, (std::vector<std::string>{"Bottom", "H1", "H2", "H3", "E", "H4", "Top"}));
  EXPECT_EQ(levels->unit_count(), 6u);
}

TEST(StratigraphicLevels, give_what_lies_on_an_onlap_surface_to_the_unit_below_its_roof) {
  const Result<LabelledTets> tets = label_tets(support::filled(*onlap_on_fold(), 80));  // U, then H1 that ends on it, H2
  ASSERT_TRUE(tets);
  const Result<StratigraphicLevels> levels = find_stratigraphic_levels(*tets);
  ASSERT_TRUE(levels) << describe(levels.failure());
  EXPECT_EQ(levels->names, (std::vector<std::string>{"Bottom", "U", "H1", "H2", "Top"}));
  for (std::uint32_t t = 0; t < tets->tets.size(); ++t) {
    double z = 0;
    for (const std::uint32_t p : tets->tets[t]) z += 0.25 * tets->points[p].z;
    EXPECT_EQ(levels->unit[t] == 3, z > 400) << z;
  }
}

TEST(StratigraphicLevels, refuse_a_horizon_that_ends_inside_a_region_by_name) {
  VolumeMesh mesh = support::filled(*vertical_faults(1, false), 150);
  for (Entity& entity : mesh.entities)
    if (entity.name == "F1") entity.role = Role::horizon;  // a wall is below and above nothing: H1 … H3 are cut by it
  std::size_t half = 0;
  for (MeshFacet& facet : mesh.facets)  // and half of H2 is gone
    if (mesh.entities[static_cast<std::size_t>(mesh.surface_entity[facet.surface])].name == "H2" && ++half % 2 == 0)
      facet.surface = no_index;
  std::erase_if(mesh.facets, [](const MeshFacet& facet) { return facet.surface == no_index; });
  const Result<LabelledTets> tets = label_tets(mesh);
  ASSERT_TRUE(tets);
  const Result<StratigraphicLevels> levels = find_stratigraphic_levels(*tets);
  ASSERT_FALSE(levels);
  EXPECT_EQ(levels.failure().code, FailureCode::unsupported);
  EXPECT_NE(levels.failure().what.find("H2"), std::string::npos);
}

}  // namespace
}  // namespace strataflow
