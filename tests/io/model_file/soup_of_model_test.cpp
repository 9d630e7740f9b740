#include "model/soup_of_model.h"

#include <gtest/gtest.h>

#include "io/two_tetrahedra.h"

namespace strataflow {
namespace {

TEST(SoupOfModel, keeps_surfaces_entities_regions_and_layers) {
  const StructuralModel model = support::two_tetrahedra();
  const TriangleSoup soup = soup_of_model(model);
  EXPECT_EQ(soup.points, model.points);
  EXPECT_EQ(soup.local_origin, model.local_origin);
  EXPECT_EQ(soup.entities[0].name, "F1");
  ASSERT_EQ(soup.regions.size(), 2u);
  EXPECT_EQ(soup.regions[1].name, "below");
  ASSERT_EQ(soup.regions[1].sides.size(), 2u);
  EXPECT_EQ(soup.regions[1].sides[1].patch, 2u);
  EXPECT_EQ(soup.regions[1].sides[1].is_positive, 0);
  EXPECT_EQ(soup.layers[0].regions, (std::vector<std::uint32_t>{0, 1}));
}

TEST(SoupOfModel, keeps_every_entity_of_a_coincident_surface_without_repeating_it) {
  StructuralModel model = support::two_tetrahedra();  // its fault is one triangle of F1 and of the box
  const TriangleSoup soup = soup_of_model(model);
  EXPECT_EQ(soup.triangles, model.triangles);
  EXPECT_EQ(soup.patch_entity[0], 0u);
  EXPECT_EQ(soup.patch_other_entities, (std::vector<std::vector<std::uint32_t>>{{1}, {}, {}}));
  EXPECT_EQ(soup.entities_of(0), model.surfaces[0].all_entities);
  model.surfaces[0].all_entities = {0};
  EXPECT_TRUE(soup_of_model(model).patch_other_entities.empty());
}

TEST(PatchesOfModel, are_the_soup_without_its_points_and_triangles) {
  const StructuralModel model = support::two_tetrahedra();
  const TriangleSoup soup = soup_of_model(model), patches = patches_of_model(model);
  EXPECT_TRUE(patches.points.empty());
  EXPECT_TRUE(patches.triangles.empty());
  EXPECT_EQ(patches.local_origin, soup.local_origin);
  EXPECT_EQ(patches.patch_entity, soup.patch_entity);
  EXPECT_EQ(patches.patch_other_entities, soup.patch_other_entities);
  EXPECT_EQ(patches.regions.size(), soup.regions.size());
  EXPECT_EQ(patches.layers.size(), soup.layers.size());
}

}  // namespace
}  // namespace strataflow
