#include <gtest/gtest.h>

#include <cmath>

#include "kernels/reference_models/reference_plans.h"

namespace strataflow {
namespace {

TEST(FaultNetwork, throws_its_horizons_by_10_to_60_m_and_not_at_all_beyond_its_tips) {
  const auto model = fault_network();
  // Fault 3 lies on the second line to the north, from station 3 to 11; its neighbours are blocks 1 and 2 of a row.
  const auto throw_m = [&](double station) {
    const auto row = static_cast<std::uint32_t>(station / 2);
    const MapPoint p{4, station, 0};
    return model->height(7 * row + 2, 2, p) - model->height(7 * row + 1, 2, p);
  };
  EXPECT_EQ(throw_m(2.5), 0);
  EXPECT_EQ(throw_m(3), 0);
  EXPECT_GT(std::abs(throw_m(6.5)), 4);
  EXPECT_LT(std::abs(throw_m(6.5)), 60);
  EXPECT_EQ(throw_m(11), 0);
  EXPECT_EQ(throw_m(12.5), 0);
}

TEST(FaultNetwork, keeps_the_sides_of_the_box_flat_and_bends_what_lies_between) {
  const auto model = fault_network();
  EXPECT_EQ(model->at(0, {0, 5, 0}, 300).x, 0);
  EXPECT_EQ(model->at(6, {14, 5, 0}, 300).x, 12000);
  const Vec3 low = model->at(1, {4, 7, 0}, 0), high = model->at(1, {4, 7, 0}, 1700);
  EXPECT_GT(length(Vec3{low.x - high.x, low.y - high.y, 0}), 400) << "faults dip";
}

}  // namespace
}  // namespace strataflow
