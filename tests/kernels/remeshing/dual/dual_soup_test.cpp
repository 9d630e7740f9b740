#include "kernels/remeshing/dual/dual_soup.h"

#include "kernels/remeshing/dual/dual_samples.h"

namespace strataflow {
namespace {

using sample::dual_of;
using sample::Patches;

StructuralModel two_sheets(double gap) {
  const auto sheet = [](double z) { return sample::rectangle({0, 0, z}, {1, 0, 0}, {0, 1, 0}, 4, 4); };
  return Patches().add("H1", Role::horizon, sheet(0)).add("H2", Role::horizon, sheet(gap)).model();
}

TEST(DualSoup, joined_sheets_are_one_surface_of_both_features) {
  const StructuralModel model = two_sheets(0.01);
  const sample::Dual dual =
      dual_of(model, sample::random_sites(30, 4, {0, 0, 0}, {1, 1, 0.01}), {.resolution_m = 0.05});
  const DualSoup made = make_dual_soup(model, dual.mesh);
  EXPECT_EQ(2 * made.soup.triangles.size(), dual.mesh.triangles.size());
  ASSERT_EQ(made.patch_surfaces.size(), 3u);
  EXPECT_EQ(made.patch_surfaces[2], (std::vector<std::uint32_t>{0, 1}));
  const StructuralModel joined = build_structural_model(made.soup)->model;
  ASSERT_EQ(joined.surfaces.size(), 1u);
  EXPECT_EQ(joined.surfaces[0].all_entities, (std::vector<std::uint32_t>{0, 1}));
}

TEST(DualSoup, surfaces_apart_keep_their_own_patches_and_entities) {
  const StructuralModel model = two_sheets(0.5);
  const sample::Dual dual = dual_of(model, sample::random_sites(60, 4, {0, 0, 0}, {1, 1, 0.5}));
  const DualSoup made = make_dual_soup(model, dual.mesh);
  EXPECT_EQ(made.patch_surfaces.size(), 2u);
  EXPECT_EQ(made.soup.triangle_patch, dual.mesh.triangle_surface);
  EXPECT_EQ(made.soup.patch_entity, (std::vector<std::uint32_t>{0, 1}));
}

TEST(DualSoup, every_point_is_used_and_names_its_site) {
  const StructuralModel model = sample::reference("A4", 160);
  const auto sites = sample::sites_in_box(model, 60, 3);
  const DualSoup made = make_dual_soup(model, dual_of(model, sites).mesh);
  std::vector<char> is_used(made.soup.points.size(), 0);
  for (const Triangle& t : made.soup.triangles)
    for (const std::uint32_t corner : t) is_used[corner] = 1;
  EXPECT_EQ(std::count(is_used.begin(), is_used.end(), 0), 0);
  ASSERT_EQ(made.points.size(), made.soup.points.size());
  for (std::size_t p = 0; p < made.points.size(); ++p) {
    EXPECT_EQ(made.points[p].position, made.soup.points[p]);
    EXPECT_LT(made.points[p].site, sites.size());
  }
}

}  // namespace
}  // namespace strataflow
