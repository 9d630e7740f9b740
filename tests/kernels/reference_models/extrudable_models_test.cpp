#include "kernels/reference_models/extrudable_models.h"

#include <gtest/gtest.h>

#include "kernels/reference_models/seal_columns.h"
#include "kernels/reference_models/soup_topology.h"
#include "kernels/topology/building/build_structural_model.h"

namespace strataflow {
namespace {

std::size_t region_count(const ColumnModel& columns, double edge_m) {
  const Result<BuiltModel> built = build_structural_model(seal_columns(columns, edge_m));
  EXPECT_TRUE(built);
  if (!built) return 0;
  EXPECT_TRUE(built->model.is_sealed);
  double volume_m3 = 0;
  for (const Region& region : built->model.regions) volume_m3 += region.volume_m3;
  const Vec3 size = columns.box.high - columns.box.low;
  EXPECT_NEAR(volume_m3 / (size.x * size.y * size.z), 1, 1e-9);
  return built->model.regions.size();
}

/// Largest height difference of the points where a horizon's pieces end on one fault, seen from above.
double largest_throw_m(const ColumnModel& columns, std::uint32_t west, std::uint32_t east, const MapPoint& p) {
  return columns.height(west, 2, p) - columns.height(east, 2, p);
}

TEST(ExtrudableModels, every_number_of_vertical_faults_seals_the_box) {
  for (std::uint32_t faults = 0; faults <= 12; ++faults)
    EXPECT_GE(region_count(*vertical_faults(faults, faults % 2 == 1), 70), 4u) << faults << " faults";
}

TEST(ExtrudableModels, horizons_end_only_on_faults_and_sides) {
  const TriangleSoup soup = seal_columns(*vertical_faults(12, true), 60);
  const testing_support::SoupTopology topology = testing_support::topology_of(soup);
  for (const auto& edge : topology.free_edges)
    for (const std::uint32_t t : topology.edge_triangles.at(edge))
      EXPECT_EQ(soup.entities[testing_support::entity_of(soup, t)].role, Role::fault);
}

TEST(ExtrudableModels, vertical_faults_are_vertical_and_displace_what_they_cut) {
  const auto columns = vertical_faults(1, true);
  const MapPoint on_fault{5, 6.5, 0};
  EXPECT_EQ(columns->at(0, on_fault, 0).x, columns->at(0, on_fault, 400).x);
  EXPECT_NEAR(largest_throw_m(*columns, 6 * 12 + 4, 6 * 12 + 5, on_fault), 30, 1e-9);
}

TEST(ExtrudableModels, a_dying_fault_has_no_throw_at_its_tips) {
  const auto columns = vertical_faults(2, false);
  EXPECT_NEAR(largest_throw_m(*columns, 6 * 12 + 2, 7 * 12 + 2, {2, 7, 0}), 0, 1e-9);
  EXPECT_GT(std::abs(largest_throw_m(*columns, 6 * 12 + 6, 7 * 12 + 6, {6.5, 7, 0})), 10);
}

TEST(ExtrudableModels, dipping_and_listric_faults_cut_every_horizon) {
  EXPECT_EQ(region_count(*dipping_faults(std::array{0.17632698070846498, 0.57735026918962576, 1.0}, 15), 60), 12u);
  EXPECT_EQ(region_count(*listric_fault(), 60), 6u);
}

TEST(ExtrudableModels, the_listric_fault_flattens_from_80_to_20_degrees) {
  const auto columns = listric_fault();
  const auto slope = [&](double z) {
    return (columns->at(0, {1, 500, 0}, z).x - columns->at(0, {1, 500, 0}, z + 1e-3).x) / 1e-3;
  };
  EXPECT_NEAR(std::atan2(1, slope(399.999)) * 180 / M_PI, 80, 0.01);
  EXPECT_NEAR(std::atan2(1, slope(0)) * 180 / M_PI, 20, 0.01);
}

TEST(ExtrudableModels, the_erosion_ends_two_of_four_horizons) {
  for (const bool has_fault : {false, true}) {
    const TriangleSoup soup = seal_columns(*unconformity(has_fault), 60);
    const auto reach = [&](const char* name) {
      double east = 0;
      for (const Vec3& p : testing_support::points_of(soup, name)) east = std::max(east, p.x);
      return east;
    };
    EXPECT_EQ(reach("H1"), 1600);
    EXPECT_LT(reach("H2"), 1600);
    EXPECT_LT(reach("H3"), reach("H2"));
    EXPECT_EQ(region_count(*unconformity(has_fault), 60), has_fault ? 10u : 6u);
  }
}

TEST(ExtrudableModels, thin_layers_are_a_centimetre_thick) {
  const auto columns = thin_layers();
  EXPECT_NEAR(columns->height(0, 4, {0.3, 200, 0}) - columns->height(0, 3, {0.3, 200, 0}), 0.01, 1e-9);
  EXPECT_EQ(region_count(*columns, 50), 10u);
}

}  // namespace
}  // namespace strataflow
