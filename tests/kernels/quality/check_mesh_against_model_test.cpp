#include "kernels/quality/check_mesh_against_model.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "kernels/quality/two_layers.h"

namespace strataflow {
namespace {

using Kinds = std::vector<std::string>;

Kinds kinds_of(const TwoLayers& layers) {
  Kinds words;
  for (const Violation& v : check_mesh_against_model(layers.mesh, layers.model)) words.push_back(v.kind);
  return words;
}

TEST(CheckMeshAgainstModel, a_mesh_that_fills_its_model_has_no_violation) { EXPECT_EQ(kinds_of(TwoLayers()), Kinds{}); }

TEST(CheckMeshAgainstModel, a_cell_in_the_wrong_region_changes_both_volumes_and_its_facets) {
  TwoLayers layers;
  layers.mesh.cell_region[0] = 1;
  EXPECT_EQ(kinds_of(layers), (Kinds{"region_volume_mismatch", "region_volume_mismatch", "facet_mismatch"}));
}

TEST(CheckMeshAgainstModel, a_cell_without_a_region_is_named) {
  TwoLayers layers;
  layers.mesh.cell_region[5] = -1;
  EXPECT_EQ(kinds_of(layers)[1], "cell_without_region");
}

TEST(CheckMeshAgainstModel, a_volume_off_by_two_in_a_billion_is_seen_and_half_of_one_is_not) {
  TwoLayers layers;
  layers.model.regions[0].volume_m3 = 4 * (1 + 5e-10);
  EXPECT_EQ(kinds_of(layers), Kinds{});
  layers.model.regions[0].volume_m3 = 4 * (1 + 2e-9);
  EXPECT_EQ(kinds_of(layers), Kinds{"region_volume_mismatch"});
}

TEST(CheckMeshAgainstModel, a_missing_facet_leaves_its_surface_uncovered) {
  TwoLayers layers;
  layers.mesh.facets.pop_back();
  EXPECT_EQ(kinds_of(layers), Kinds{"surface_not_covered"});
}

TEST(CheckMeshAgainstModel, a_facet_that_names_a_cell_it_is_not_part_of_is_a_mismatch) {
  TwoLayers layers;
  layers.mesh.facets[0].cell_0 = layers.mesh.facets[0].cell_0 == 0 ? 40 : 0;
  EXPECT_EQ(kinds_of(layers), Kinds{"facet_mismatch"});
}

TEST(CheckMeshAgainstModel, regions_that_do_not_share_their_faces_leave_a_crack) {
  TwoLayers layers;
  const auto offset = static_cast<std::uint32_t>(layers.mesh.points.size());
  const auto points = layers.mesh.points;
  layers.mesh.points.insert(layers.mesh.points.end(), points.begin(), points.end());
  for (std::uint32_t cell = 0; cell < layers.mesh.cell_count(); ++cell)
    for (std::uint32_t i = layers.mesh.cell_offsets[cell]; i < layers.mesh.cell_offsets[cell + 1]; ++i)
      if (layers.mesh.cell_region[cell] == 1) layers.mesh.cell_vertices[i] += offset;
  EXPECT_EQ(kinds_of(layers).back(), "boundary_mismatch");
}

}  // namespace
}  // namespace strataflow
