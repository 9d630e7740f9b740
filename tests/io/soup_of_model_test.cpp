#include "io/soup_of_model.h"

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

TEST(SoupOfModel, gives_every_entity_of_a_coincident_surface_its_own_copy) {
  const StructuralModel model = support::two_tetrahedra();  // its fault is one triangle of F1 and of the box
  const TriangleSoup soup = soup_of_model(model);
  ASSERT_EQ(soup.triangles.size(), model.triangles.size() + 1);
  EXPECT_EQ(soup.triangles.back(), model.triangles[0]);
  EXPECT_EQ(soup.patch_entity[soup.triangle_patch[0]], 0u);
  EXPECT_EQ(soup.patch_entity[soup.triangle_patch.back()], 1u);
}

}  // namespace
}  // namespace strataflow
