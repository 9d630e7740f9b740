#include "kernels/sealing/without_surfaces.h"

#include <gtest/gtest.h>

#include "kernels/contacts/raw_surfaces.h"

namespace strataflow {
namespace {

std::vector<std::uint32_t> surfaces_of(const StructuralModel& model, std::uint32_t entity) {
  std::vector<std::uint32_t> list;
  for (std::uint32_t s = 0; s < model.surfaces.size(); ++s)
    if (model.surfaces[s].entity == entity) list.push_back(s);
  return list;
}

TEST(WithoutSurfaces, only_the_named_surface_goes_and_two_regions_become_one) {
  const TriangleSoup soup = support::layered_box({0, 1, 2});
  const StructuralModel model = build_structural_model(soup)->model;
  const TriangleSoup rest = without_surfaces(soup, model, surfaces_of(model, 1));
  EXPECT_EQ(rest.triangles.size(), soup.triangles.size() - 2);
  EXPECT_EQ(rest.triangle_patch.size(), rest.triangles.size());
  EXPECT_EQ(support::region_volumes(rest), std::vector<double>{2});
  EXPECT_EQ(without_surfaces(soup, model, {}).triangles, soup.triangles);
}

TEST(WithoutSurfaces, every_copy_goes_whoever_it_is_of_and_however_its_corners_are_stored) {
  TriangleSoup soup = support::layered_box({0, 1, 2});
  const std::size_t without = soup.triangles.size() - 2;
  // The same two triangles turned over, as a second entity.
  support::add_quad(soup, support::add_patch(soup, "U", Role::unconformity), {0, 0, 1}, {0, 1, 1}, {1, 1, 1},
                    {1, 0, 1});
  const StructuralModel model = build_structural_model(soup)->model;
  std::vector<std::uint32_t> both = surfaces_of(model, 2);
  for (const std::uint32_t s : surfaces_of(model, 1)) both.push_back(s);
  ASSERT_FALSE(both.empty());
  EXPECT_EQ(without_surfaces(soup, model, both).triangles.size(), without);
}

}  // namespace
}  // namespace strataflow
