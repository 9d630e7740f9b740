#include "base/result.h"

#include <gtest/gtest.h>

#include "base/failure.h"
#include "base/internal_error.h"

namespace strataflow {
namespace {

Result<int> half(int x) {
  if (x % 2 != 0) return Failure{FailureCode::invalid_input, "odd: " + std::to_string(x), "give an even number"};
  return x / 2;
}

TEST(Result, holds_a_value_or_a_reason) {
  EXPECT_EQ(*half(4), 2);
  ASSERT_FALSE(half(3));
  EXPECT_EQ(half(3).failure().what, "odd: 3");
  EXPECT_EQ(describe(half(3).failure()), "odd: 3 (give an even number)");
}

TEST(Result, reading_the_wrong_side_is_our_bug_and_says_where) {
  EXPECT_THROW(half(3).value(), InternalError);
  EXPECT_THROW(half(4).failure(), InternalError);
  try {
    STRATAFLOW_ASSERT(1 > 2, "arithmetic");
    FAIL();
  } catch (const InternalError& error) {
    EXPECT_NE(std::string(error.what()).find("arithmetic [1 > 2]"), std::string::npos);
  }
}

TEST(Failure, every_code_has_a_word_of_its_own) {
  std::vector<std::string_view> words;
  for (int code = 0; code <= static_cast<int>(FailureCode::internal_error); ++code)
    words.push_back(to_string(static_cast<FailureCode>(code)));
  std::sort(words.begin(), words.end());
  EXPECT_EQ(std::unique(words.begin(), words.end()), words.end());
}

}  // namespace
}  // namespace strataflow
