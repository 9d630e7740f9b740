#include "kernels/cutting/merge_coincident.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "kernels/cutting/cut_surfaces.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/validity/check_validity.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

using support::add_patch;
using support::add_quad;

CutMesh mesh_of(const TriangleSoup& soup) {
  CutMesh mesh{soup.points, soup.triangles, {}, std::vector<char>(soup.triangles.size(), 1)};
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) mesh.origin.push_back(t);
  return mesh;
}

/// One triangle on three points for each of these patches, in any turn.
TriangleSoup stack_of(const std::vector<std::uint32_t>& patches) {
  TriangleSoup soup;
  add_patch(soup, "H1", Role::horizon);
  add_patch(soup, "F", Role::fault);
  add_patch(soup, "H2", Role::horizon);
  soup.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (std::uint32_t i = 0; i < patches.size(); ++i)
    soup.triangles.push_back(i % 2 ? Triangle{1, 0, 2} : Triangle{0, 1, 2});
  soup.triangle_patch = patches;
  return soup;
}

TEST(MergeCoincident, identical_triangles_become_one_of_the_youngest_and_the_others) {
  const TriangleSoup soup = stack_of({0, 1, 2});
  CutMesh mesh = mesh_of(soup);
  TriangleSoup out;
  std::vector<Change> changes;
  EXPECT_EQ(merge_coincident(mesh, soup, out, changes), std::vector<std::uint32_t>{3});
  EXPECT_EQ(mesh.triangles, std::vector<Triangle>{soup.triangles[1]}) << "the fault's own, turned as it is";
  EXPECT_EQ(mesh.origin, std::vector<std::uint32_t>{1});
  EXPECT_EQ(out.patch_entity, (std::vector<std::uint32_t>{0, 1, 2, 1}));
  EXPECT_EQ(out.patch_other_entities, (std::vector<std::vector<std::uint32_t>>{{}, {}, {}, {0, 2}}));
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].kind, "coincident_patches");
  EXPECT_EQ(changes[0].what, "'H1', 'F' and 'H2' share 1 triangles");
}

TEST(MergeCoincident, what_already_stands_for_all_takes_in_a_copy_without_a_word) {
  TriangleSoup soup = stack_of({1, 0});
  soup.patch_other_entities = {{}, {0}, {}};
  CutMesh mesh = mesh_of(soup);
  TriangleSoup out;
  std::vector<Change> changes;
  EXPECT_EQ(merge_coincident(mesh, soup, out, changes), std::vector<std::uint32_t>{1});
  EXPECT_EQ(out.patch_entity.size(), 3u);
  EXPECT_EQ(out.patch_other_entities, soup.patch_other_entities);
  EXPECT_TRUE(changes.empty());
}

TEST(MergeCoincident, nothing_changes_where_nothing_coincides) {
  const TriangleSoup soup = support::layered_box({0, 1, 2});
  CutMesh mesh = mesh_of(soup);
  TriangleSoup out;
  std::vector<Change> changes;
  EXPECT_EQ(merge_coincident(mesh, soup, out, changes), soup.triangle_patch);
  EXPECT_EQ(mesh.triangles, soup.triangles);
  EXPECT_EQ(out.patch_entity, soup.patch_entity);
  EXPECT_TRUE(out.patch_other_entities.empty());
  EXPECT_TRUE(changes.empty());
}

/// Two horizons that share the plane z = 1 for x < 1, triangulated otherwise there, and part beyond.
TriangleSoup overlapping_horizons() {
  TriangleSoup soup;
  const std::uint32_t old = add_patch(soup, "old", Role::horizon), young = add_patch(soup, "young", Role::horizon);
  add_quad(soup, old, {0, 0, 1}, {2, 0, 1}, {2, 1, 1}, {0, 1, 1});
  add_quad(soup, young, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {0, 0, 1});
  add_quad(soup, young, {1, 0, 1}, {2, 0, 2}, {2, 1, 2}, {1, 1, 1});
  soup.properties = {{"v", "", 1, {}}};
  for (const Vec3& p : soup.points) soup.properties[0].values.push_back(p.x);
  return soup;
}

TEST(MergeCoincident, a_cut_leaves_one_surface_where_horizons_coincide_and_the_census_is_empty) {
  const Result<CutResult> cut = cut_surfaces(overlapping_horizons());
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->report.pairs_left, 0u);
  EXPECT_EQ(cut->report.rounds, 1u);
  EXPECT_EQ(cut->soup.properties[0].values.size(), cut->soup.points.size());
  ASSERT_EQ(cut->soup.patch_entity, (std::vector<std::uint32_t>{0, 1, 1}));
  EXPECT_EQ(cut->soup.patch_other_entities.back(), std::vector<std::uint32_t>{0});
  double area = 0;
  for (std::size_t t = 0; t < cut->soup.triangles.size(); ++t) {
    const Triangle& v = cut->soup.triangles[t];
    if (cut->soup.triangle_patch[t] == 2)
      area += 0.5 * length(cross(cut->soup.points[v[1]] - cut->soup.points[v[0]],
                                 cut->soup.points[v[2]] - cut->soup.points[v[0]]));
  }
  EXPECT_DOUBLE_EQ(area, 1);
  const Result<BuiltModel> built = build_structural_model(cut->soup);
  ASSERT_TRUE(built);
  EXPECT_EQ(check_validity(*built).intersecting_triangle_pairs, 0u);
  EXPECT_EQ(built->model.surfaces.size(), 3u);
  EXPECT_THAT(cut->changes, testing::Contains(testing::Field(&Change::kind, "coincident_patches")));
}

TEST(MergeCoincident, surfaces_that_only_coincide_are_merged_without_a_round_of_cutting) {
  TriangleSoup soup = support::layered_box({0, 0.5, 1});
  support::add_sheet(soup, add_patch(soup, "H1 again", Role::horizon), {0, 0, 0}, {1, 1, 1}, 0.5);
  const Result<CutResult> cut = cut_surfaces(soup);
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->report.rounds, 0u);
  EXPECT_EQ(cut->soup.triangles.size(), soup.triangles.size() - 2);
  EXPECT_EQ(cut->report.intersecting_pairs, 2u);
}

}  // namespace
}  // namespace strataflow
