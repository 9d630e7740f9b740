#include "base/index_range.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

TEST(IndexRange, ends_before_the_index_that_means_none) {
  EXPECT_TRUE(check_index_range(0, "points", "a.ts"));
  EXPECT_TRUE(check_index_range(0xfffffffe, "points", "a.ts"));
  for (const std::uint64_t count : {std::uint64_t{no_index}, std::uint64_t{1} << 32, std::uint64_t{1} << 40}) {
    const Result<void> checked = check_index_range(count, "points", "a.ts");
    ASSERT_FALSE(checked) << count;
    EXPECT_EQ(checked.failure().code, FailureCode::unsupported);
    EXPECT_EQ(checked.failure().what.find("a.ts: " + std::to_string(count) + " points"), 0u);
  }
}

}  // namespace
}  // namespace strataflow
