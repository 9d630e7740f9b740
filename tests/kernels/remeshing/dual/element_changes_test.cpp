#include "kernels/remeshing/dual/element_changes.h"

#include "kernels/remeshing/dual/dual_samples.h"
#include "kernels/voronoi/sample_sites.h"

namespace strataflow {
namespace {

using sample::dual_of;
using sample::Patches;

struct Compared {
  StructuralModel after;
  std::vector<ElementChange> changes;
};

Compared compared(const StructuralModel& model, const std::vector<Vec3>& sites, const MergeOptions& options = {}) {
  const DualSoup made = make_dual_soup(model, dual_of(model, sites, options).mesh);
  Compared result;
  if (made.soup.triangles.empty()) {
    result.changes = compare_elements(model, made, result.after);
  } else {
    result.after = build_structural_model(made.soup)->model;
    result.changes = compare_elements(model, made, result.after);
  }
  return result;
}

StructuralModel sheets(std::vector<double> heights) {
  Patches patches;
  for (std::size_t k = 0; k < heights.size(); ++k)
    patches.add("H" + std::to_string(k + 1), Role::horizon,
                sample::rectangle({0, 0, heights[k]}, {1, 0, 0}, {0, 1, 0}, 4, 4));
  return patches.model();
}

TEST(ElementChanges, a_dual_of_many_sites_changes_nothing) {
  const StructuralModel model = sheets({0, 0.5});
  EXPECT_TRUE(compared(model, sample::random_sites(200, 3, {0, 0, 0}, {1, 1, 0.5})).changes.empty());
}

TEST(ElementChanges, joined_sheets_are_told_as_merged_with_their_borders) {
  const StructuralModel model = sheets({0, 0.01});
  const Compared result = compared(model, sample::random_sites(30, 4, {0, 0, 0}, {1, 1, 0.01}), {.resolution_m = 0.05});
  ASSERT_EQ(result.changes.size(), 2u);
  EXPECT_EQ(describe(result.changes[0], model, result.after), "line merged: 0 (H1), 1 (H2) → 0 (H2)");
  EXPECT_EQ(describe(result.changes[1], model, result.after), "surface merged: 0 (H1), 1 (H2) → 0 (H1 × H2)");
}

TEST(ElementChanges, a_sheet_within_one_cell_is_lost_with_its_border) {
  Patches patches;
  patches.add("H1", Role::horizon, sample::rectangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 4, 4));
  patches.add("small", Role::fault, sample::rectangle({0.5, 0.5, 0.05}, {0.01, 0, 0}, {0, 0.01, 0}, 1, 1));
  const StructuralModel model = patches.model();
  const Compared result = compared(model, sample_sites(model.points, model.triangles, {}, 20, 1));
  ASSERT_EQ(result.changes.size(), 2u);
  EXPECT_EQ(describe(result.changes[0], model, result.after), "line lost: 1 (small)");
  EXPECT_EQ(describe(result.changes[1], model, result.after), "surface lost: 1 (small)");
}

TEST(ElementChanges, a_model_in_one_cell_is_lost_altogether) {
  const StructuralModel model = sheets({0});
  const Compared result = compared(model, {{0, 0, 0}});
  ASSERT_EQ(result.changes.size(), 2u);
  for (const ElementChange& change : result.changes) EXPECT_EQ(change.kind, ChangeKind::lost);
}

TEST(ElementChanges, corners_linked_in_one_cell_are_told_as_merged) {
  const StructuralModel model = sample::reference("A4", 100);
  const auto sites = sample_sites(model.points, model.triangles, {}, 300, 1);
  const sample::Dual dual = dual_of(model, sites);
  const DualSoup made = make_dual_soup(model, dual.mesh);
  const StructuralModel after = build_structural_model(made.soup)->model;
  std::vector<std::vector<std::uint32_t>> merged;
  for (const ElementChange& change : compare_elements(model, made, after))
    if (change.element == ElementKind::corner && change.kind == ChangeKind::merged) merged.push_back(change.before);
  std::size_t expected = 0;
  for (const PointMerge& merge : dual.points.merges)
    if (merge.corners.size() > 1) {
      ++expected;
      EXPECT_NE(std::find(merged.begin(), merged.end(), merge.corners), merged.end());
    }
  EXPECT_GT(expected, 0u);
}

}  // namespace
}  // namespace strataflow
