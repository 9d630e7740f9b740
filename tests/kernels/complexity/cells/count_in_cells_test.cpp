#include "kernels/complexity/cells/count_in_cells.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "kernels/complexity/cells/ball_pieces.h"
#include "kernels/complexity/cells/voxel_pieces.h"
#include "kernels/complexity/models.h"

namespace strataflow {
namespace {

std::vector<CellCount> counts_of(const StructuralModel& model, const CellPieces& pieces,
                                 CountBy by = CountBy::components, double edge_length_m = 0.05) {
  const BoxElements box = find_box_elements(model);
  const GeometricSamples samples = sample_geometry(model, box, edge_length_m);
  return count_in_cells(model, box, samples, measure_geometric_complexity(model, box, samples, edge_length_m, 20),
                        pieces, by);
}

TEST(CountInCells, a_cell_inside_a_region_counts_one_and_a_surface_with_its_two_regions_three) {
  const StructuralModel model = model_of(support::layered_box({0, 0.3, 1}));
  const auto counts = counts_of(model, cut_by_voxels(model, cut_into_voxels(model.box, 8)));
  for (std::size_t cell = 0; cell < 8; ++cell) EXPECT_EQ(counts[cell].total(), cell < 4 ? 3u : 1u);
}

TEST(CountInCells, the_whole_model_in_one_cell_counts_all_its_elements) {
  for (const char* name : {"A1", "A3", "A5", "B"}) {
    const StructuralModel model = reference_model(name, 100);
    const ElementCounts all = count_elements(model, find_box_elements(model));
    for (const CountBy by : {CountBy::components, CountBy::elements}) {
      const CellCount count = counts_of(model, cut_by_voxels(model, cut_into_voxels(model.box, 1)), by, 10).front();
      EXPECT_EQ(count.regions, all.regions) << name;
      EXPECT_EQ(count.surfaces, all.surfaces) << name;
      EXPECT_EQ(count.lines, all.lines) << name;
      EXPECT_EQ(count.corners, all.corners) << name;
    }
  }
}

TEST(CountInCells, a_surface_that_comes_twice_counts_twice_by_components_and_once_by_elements) {
  TriangleSoup soup = support::box({0, 0, 0}, {4, 4, 4});  // a sheet folded to two parallel limbs, 1 apart
  const std::uint32_t f = support::add_patch(soup, "F1", Role::fault);
  support::add_quad(soup, f, {1, 1, 1}, {3, 1, 1}, {3, 3, 1}, {1, 3, 1});
  support::add_quad(soup, f, {3, 1, 1}, {3, 1, 2}, {3, 3, 2}, {3, 3, 1});
  support::add_quad(soup, f, {3, 1, 2}, {1, 1, 2}, {1, 3, 2}, {3, 3, 2});
  const StructuralModel model = model_of(soup);
  const CellPieces ball = cut_by_balls(model, {{2, 2, 1.5}}, 0.9);
  EXPECT_EQ(counts_of(model, ball)[0].surfaces, 2u);
  EXPECT_EQ(counts_of(model, ball, CountBy::elements)[0].surfaces, 1u);
  EXPECT_EQ(counts_of(model, ball)[0].regions, 1u);  // the same on all sides
  EXPECT_EQ(counts_of(model, cut_by_balls(model, {{2, 2, 1.5}}, 2))[0].surfaces, 1u);  // now the bend joins them
}

TEST(CountInCells, pieces_that_share_only_a_contact_are_components_of_their_own) {
  const StructuralModel model = model_of(fault_below_horizon(45));
  const CellCount count = counts_of(model, cut_by_balls(model, {{5, 5, 2}}, 1))[0];
  EXPECT_EQ(count.surfaces, 3u);
  EXPECT_EQ(count.lines, 1u);
  EXPECT_EQ(count.regions, 3u);
  EXPECT_EQ(count.corners, 0u);
}

TEST(CountInCells, features_are_not_split_by_contacts_and_lines_do_not_count) {
  const StructuralModel model = model_of(fault_below_horizon(45));
  const CellCount count = counts_of(model, cut_by_balls(model, {{5, 0, 2}}, 1), CountBy::features)[0];
  EXPECT_EQ(count.surfaces, 2u);  // the horizon on both sides of the contact, and the fault
  EXPECT_EQ(count.regions, 3u);
  EXPECT_EQ(count.total(), 5u);
}

TEST(CountInCells, refining_the_triangles_changes_nothing) {  // M3
  const TriangleSoup soup = fault_below_horizon(30);
  const StructuralModel coarse = model_of(soup), fine = model_of(refined(refined(soup)));
  const VoxelGrid grid = cut_into_voxels(coarse.box, 300);
  const auto before = counts_of(coarse, cut_by_voxels(coarse, grid)), after = counts_of(fine, cut_by_voxels(fine, grid));
  for (std::size_t c = 0; c < before.size(); ++c) {
    EXPECT_EQ(before[c].total(), after[c].total()) << c;
    EXPECT_NEAR(before[c].area_m2, after[c].area_m2, 1e-9);
  }
}

TEST(CountInCells, a_thin_layer_shows_in_the_cells_it_passes_with_the_edge_they_need) {
  const StructuralModel model = model_of(support::layered_box({0, 0.3, 0.32, 1}));
  const auto counts = counts_of(model, cut_by_voxels(model, cut_into_voxels(model.box, 8)));
  EXPECT_NEAR(counts[0].thin_ratio, 0.5, 1e-12);  // one side of each horizon
  EXPECT_NEAR(counts[0].needed_edge_m, 0.02, 1e-12);
  EXPECT_EQ(counts[0].roughness_ratio, 0);
  EXPECT_DOUBLE_EQ(counts[7].needed_edge_m, 0.5);
}

TEST(CellStatistics, are_the_textbook_ones_and_leave_out_cells_outside) {
  std::vector<CellCount> counts(11);
  for (std::uint32_t i = 0; i < 10; ++i) counts[i].regions = i + 1;
  const CellStatistics found = statistics_of(counts, 7);
  EXPECT_EQ(found.cells, 10u);
  EXPECT_EQ(found.q10, 1u);
  EXPECT_EQ(found.q50, 5u);
  EXPECT_EQ(found.q90, 9u);
  EXPECT_EQ(found.max, 10u);
  EXPECT_EQ(found.above_6, 4u);
  EXPECT_DOUBLE_EQ(found.mean, 5.5);
  EXPECT_NEAR(found.cv, std::sqrt(82.5 / 9) / 5.5, 1e-15);
}

}  // namespace
}  // namespace strataflow
