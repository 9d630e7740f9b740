#include "kernels/hexes/extrusion/bridged_levels.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

const std::vector<std::uint32_t> two_a_unit{0, 2, 4, 6, 8};

PlumbPiece above_fault(double low_z, double high_z, double low_w, double high_w) {
  return {low_z, high_z, low_w, high_w, 1, true, false};
}

TEST(BridgedLevels, lie_evenly_between_the_horizons_that_a_gap_leaves) {
  const BridgedLevels levels(PlumbLine({{0, 50, 0, 2.5, 0}, above_fault(50, 85, 4.5, 8)}), two_a_unit);
  ASSERT_TRUE(levels.is_needed());
  EXPECT_FALSE(levels.at(1).is_bridged);
  EXPECT_DOUBLE_EQ(levels.at(1).z, 20);
  EXPECT_FALSE(levels.at(2).is_bridged);
  for (const double w : {3.0, 4.0, 5.0}) {
    EXPECT_TRUE(levels.at(w).is_bridged) << w;
    EXPECT_DOUBLE_EQ(levels.at(w).z, 40 + (w - 2) / 4 * 25) << w;  // from 40, where 2 is, to 65, where 6 is
  }
  EXPECT_DOUBLE_EQ(levels.at(4).moved_m, 2.5);  // from the fault
  EXPECT_DOUBLE_EQ(levels.at(5).moved_m, 58.75 - 55);
  EXPECT_FALSE(levels.at(7).is_bridged);
}

TEST(BridgedLevels, take_the_place_further_from_the_fault_where_horizons_come_twice) {
  const BridgedLevels levels(PlumbLine({{0, 60, 0, 6, 0}, above_fault(60, 100, 4, 8)}), two_a_unit);
  ASSERT_TRUE(levels.is_needed());
  EXPECT_DOUBLE_EQ(levels.at(4).z, 40);
  EXPECT_DOUBLE_EQ(levels.at(6).z, 80);
  EXPECT_FALSE(levels.at(4).is_bridged || levels.at(6).is_bridged);
  EXPECT_TRUE(levels.at(5).is_bridged);
  EXPECT_DOUBLE_EQ(levels.at(5).z, 60);
}

TEST(BridgedLevels, ascend_over_several_faults_on_one_line) {
  const BridgedLevels levels(
      PlumbLine(
          {{0, 45, 0, 4.5, 0}, above_fault(45, 50, 1.5, 2), above_fault(50, 60, 6.5, 7), above_fault(60, 90, 3, 8)}),
      two_a_unit);
  for (std::uint32_t w = 1; w <= 8; ++w) EXPECT_GT(levels.at(w).z, levels.at(w - 1).z) << w;
  EXPECT_DOUBLE_EQ(levels.at(0).z, 0);
  EXPECT_DOUBLE_EQ(levels.at(8).z, 90);
}

TEST(BridgedLevels, are_the_same_upside_down) {
  const BridgedLevels up(PlumbLine({{0, 50, 0, 2.5, 0}, above_fault(50, 85, 4.5, 8)}), two_a_unit);
  const BridgedLevels down(PlumbLine({{0, 35, 0, 3.5, 0}, above_fault(35, 85, 5.5, 8)}), two_a_unit);
  for (std::uint32_t w = 0; w <= 8; ++w) EXPECT_NEAR(up.at(w).z, 85 - down.at(8 - w).z, 1e-12) << w;
}

TEST(BridgedLevels, leave_other_leaps_alone) {
  EXPECT_FALSE(BridgedLevels(PlumbLine({{0, 50, 0, 2, 0}, {50, 90, 4, 8, 1}}), two_a_unit).is_needed());
  EXPECT_FALSE(BridgedLevels(PlumbLine({{0, 50, 0, 2, 0}, above_fault(50, 90, 2, 8)}), two_a_unit).is_needed());
}

}  // namespace
}  // namespace strataflow
