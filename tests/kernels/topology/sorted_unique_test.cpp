#include "kernels/topology/sorted_unique.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

TEST(SortedUnique, leaves_every_value_once_ascending) {
  EXPECT_EQ(sorted_unique({5, 1, 5, 3, 1}), (std::vector<std::uint32_t>{1, 3, 5}));
  EXPECT_TRUE(sorted_unique({}).empty());
}

}  // namespace
}  // namespace strataflow
