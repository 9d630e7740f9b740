#include "kernels/hexes/stratigraphic_levels.h"

#include <gtest/gtest.h>

#include <cmath>

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
  const Result<LabelledTets> tets =
      label_tets(support::filled(*onlap_on_fold(), 80));  // U, then H1 that ends on it, H2
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

TEST(StratigraphicLevels, pass_over_scraps_of_a_horizon_inside_a_region_and_tell_so) {
  VolumeMesh mesh = support::filled(*vertical_faults(1, false), 60);
  const Result<LabelledTets> whole = label_tets(mesh);
  ASSERT_TRUE(whole);
  const Result<StratigraphicLevels> before = find_stratigraphic_levels(*whole);
  ASSERT_TRUE(before);
  EXPECT_TRUE(before->changes.empty());
  // A face inside a region becomes one of H2: below and above that region.
  LabelledTets scrap = *whole;
  std::uint32_t h2 = 0;
  while (scrap.entities[h2].name != "H2") ++h2;
  for (std::uint32_t face = 0; face < scrap.facet_of.size(); ++face) {
    if (scrap.facet_of[face] != no_index) continue;
    const Triangle v = face_vertices(scrap.tets[face / 4], face % 4);
    const Vec3 n = cross(scrap.points[v[1]] - scrap.points[v[0]], scrap.points[v[2]] - scrap.points[v[0]]);
    if (std::abs(n.z) < 0.9 * length(n)) continue;
    SheetFacet facet;
    facet.vertices = v;
    facet.entity = h2;
    scrap.facet_of[face] = scrap.facet_of[scrap.neighbour[face]] = static_cast<std::uint32_t>(scrap.facets.size());
    scrap.facets.push_back(facet);
    break;
  }
  ASSERT_EQ(scrap.facets.size(), whole->facets.size() + 1);
  const Result<StratigraphicLevels> after = find_stratigraphic_levels(scrap);
  ASSERT_TRUE(after) << describe(after.failure());
  EXPECT_EQ(after->names, before->names);
  EXPECT_EQ(after->unit, before->unit);
  ASSERT_EQ(after->changes.size(), 1u);
  EXPECT_NE(after->changes.front().what.find("m2 of H2"), std::string::npos) << after->changes.front().what;
}

}  // namespace
}  // namespace strataflow
