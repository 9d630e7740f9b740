#include "kernels/quality/distribution.h"

#include <gtest/gtest.h>

#include <numeric>

namespace strataflow {
namespace {

TEST(Distribution, counts_values_in_equal_bins_and_those_outside_at_the_ends) {
  Distribution angles("angle_deg", 0, 100, 4);
  for (const double value : {-5.0, 10.0, 30.0, 60.0, 99.0, 100.0, 500.0}) angles.add(value);
  EXPECT_EQ(angles.bins, (std::vector<std::uint64_t>{2, 1, 1, 3}));
  EXPECT_EQ(angles.count, 7u);
  EXPECT_EQ(angles.minimum, -5.0);
  EXPECT_EQ(angles.maximum, 500.0);
  EXPECT_DOUBLE_EQ(angles.mean(), 794.0 / 7);
}

TEST(Distribution, adding_parts_gives_the_whole) {
  Distribution whole("q", 0, 1, 8), left("q", 0, 1, 8), right("q", 0, 1, 8), none("q", 0, 1, 8);
  for (int i = 0; i < 40; ++i) {
    whole.add(i / 64.0);  // exact in binary, so the sums agree to the bit
    (i < 15 ? left : right).add(i / 64.0);
  }
  left.add(none);
  left.add(right);
  EXPECT_EQ(left.bins, whole.bins);
  EXPECT_EQ(left.count, whole.count);
  EXPECT_EQ(left.sum, whole.sum);
  EXPECT_EQ(left.minimum, whole.minimum);
  EXPECT_EQ(left.maximum, whole.maximum);
  EXPECT_EQ(std::accumulate(left.bins.begin(), left.bins.end(), std::uint64_t{0}), left.count);
}

}  // namespace
}  // namespace strataflow
