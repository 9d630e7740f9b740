#include "kernels/complexity/fault_measures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kernels/complexity/models.h"

namespace strataflow {
namespace {

FaultReport faults_of(const StructuralModel& model) {
  return measure_faults(model, build_edge_table(model.points.size(), model.triangles));
}

TEST(FaultMeasures, of_a_plane_are_its_strike_dip_and_the_angle_it_makes) {
  const FaultReport found = faults_of(model_of(fault_below_horizon(35)));
  ASSERT_EQ(found.faults.size(), 1u);
  const FaultMeasures& fault = found.faults[0];
  EXPECT_NEAR(fault.dip_deg, 35, 1e-9);
  EXPECT_NEAR(fault.strike_deg, 0, 1e-9);  // dips to the east, so it strikes north
  EXPECT_EQ(fault.horizons, std::vector<std::string>{"H1"});
  EXPECT_EQ(fault.layers_affected, 2u);
  EXPECT_NEAR(fault.horizon_angle_deg.minimum, 35, 1e-9);
  EXPECT_NEAR(fault.horizon_angle_deg.maximum, 35, 1e-9);
  EXPECT_EQ(fault.free_border_m, 0);
  EXPECT_NEAR(fault.area_m2, 20 / std::sin(35 * std::numbers::pi / 180), 1e-9);
}

TEST(FaultMeasures, of_model_A2_are_two_parallel_faults_of_constant_throw_through_all_layers) {
  const FaultReport found = faults_of(reference_model("A2", 80));
  ASSERT_EQ(found.faults.size(), 2u);
  for (const FaultMeasures& fault : found.faults) {
    EXPECT_NEAR(fault.dip_deg, 60, 0.5);
    EXPECT_EQ(fault.horizons.size(), 3u);
    EXPECT_EQ(fault.layers_affected, 4u);
    EXPECT_GT(fault.throw_m.minimum, 0);
    EXPECT_LT(fault.throw_m.maximum - fault.throw_m.minimum, 0.05 * fault.throw_m.mean);
    EXPECT_TRUE(fault.faults.empty());
  }
  EXPECT_EQ(found.network.faults, 2u);
  EXPECT_EQ(found.network.contacts, 0u);
  EXPECT_NEAR(found.network.orientation_variation, 0, 1e-3);
}

TEST(FaultMeasures, of_model_A3_have_a_throw_that_dies_at_the_tip) {
  for (const FaultMeasures& fault : faults_of(reference_model("A3", 80)).faults) {
    EXPECT_GT(fault.free_border_m, 0);
    EXPECT_LT(fault.throw_m.minimum, 0.2 * fault.throw_m.maximum);
    EXPECT_GT(fault.throw_m.maximum, 0);
  }
}

TEST(FaultMeasures, of_model_A5_meet_in_a_branch_line) {
  const FaultNetworkMeasures network = faults_of(reference_model("A5", 80)).network;
  EXPECT_GE(network.contacts, 1u);
  EXPECT_GT(network.contact_length_m, 800);
  EXPECT_GT(network.smallest_angle_deg, 0);
  EXPECT_GT(network.orientation_variation, 0.01);
}

TEST(DistributionOf, weighs_by_length) {
  const LengthDistribution found = distribution_of({{3, 1}, {1, 8}, {2, 1}});
  EXPECT_EQ(found.minimum, 1);
  EXPECT_EQ(found.maximum, 3);
  EXPECT_EQ(found.q50, 1);
  EXPECT_EQ(found.q90, 2);
  EXPECT_DOUBLE_EQ(found.mean, 1.3);
  EXPECT_EQ(distribution_of({}).length_m, 0);
}

}  // namespace
}  // namespace strataflow
