#include "io/text/text_scanner.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strataflow {
namespace {

const std::string file = "model.ml";

TEST(TextScanner, reads_words_across_blanks_tabs_and_crlf_and_a_last_line_without_end) {
  TextScanner scanner("a\t b \r\n\r\n  c", file);
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.word(), "a");
  EXPECT_EQ(scanner.word(), "b");
  EXPECT_TRUE(scanner.at_line_end());
  EXPECT_EQ(scanner.word(), "");
  ASSERT_TRUE(scanner.next_content_line());
  EXPECT_EQ(scanner.word(), "c");
  EXPECT_EQ(scanner.where(), "model.ml:3");
  EXPECT_FALSE(scanner.next_line());
  EXPECT_EQ(scanner.word(), "");
}

TEST(TextScanner, a_word_in_quotes_may_hold_blanks_or_nothing) {
  TextScanner scanner("\"two words\" \"\" tail \"open end", file);
  ASSERT_TRUE(scanner.next_line());
  EXPECT_EQ(scanner.word(), "two words");
  EXPECT_EQ(scanner.word(), "");
  EXPECT_FALSE(scanner.at_line_end());
  EXPECT_EQ(scanner.word(), "tail");
  EXPECT_EQ(scanner.word(), "open end");
  EXPECT_TRUE(scanner.at_line_end());
}

TEST(TextScanner, rest_of_the_line_comes_trimmed_and_without_quotes) {
  TextScanner scanner("TSURF  my surface \nTSURF \"u1 1\" \nTSURF", file);
  scanner.next_line();
  EXPECT_EQ(scanner.word(), "TSURF");
  EXPECT_EQ(scanner.rest(), "my surface");
  scanner.next_line();
  scanner.word();
  EXPECT_EQ(scanner.rest(), "u1 1");
  scanner.next_line();
  scanner.word();
  EXPECT_EQ(scanner.rest(), "");
}

TEST(TextScanner, reads_numbers_exactly_and_refuses_what_is_none) {
  EXPECT_EQ(TextScanner::number_from("1598585.000025631"), 1598585.000025631);
  EXPECT_EQ(TextScanner::number_from("+1e-3"), 1e-3);
  EXPECT_EQ(TextScanner::number_from("2.3551745804449901e-016"), 2.3551745804449901e-016);
  EXPECT_EQ(TextScanner::number_from("-1e-999"), 0.0);
  EXPECT_TRUE(std::isnan(*TextScanner::number_from("nan")));
  EXPECT_TRUE(std::isinf(*TextScanner::number_from("-inf")));
  for (const char* wrong : {"", "x", "1e999", "1.5m", "--1", "+-1", "1,5", "+"})
    EXPECT_FALSE(TextScanner::number_from(wrong)) << wrong;
}

TEST(TextScanner, reads_integers_and_refuses_what_does_not_fit) {
  EXPECT_EQ(TextScanner::integer_from<int>("+82"), 82);
  EXPECT_EQ(TextScanner::integer_from<int>("-7"), -7);
  EXPECT_FALSE(TextScanner::integer_from<std::uint32_t>("-7"));
  EXPECT_FALSE(TextScanner::integer_from<std::uint32_t>("4294967296"));
  EXPECT_FALSE(TextScanner::integer_from<int>("1.0"));
}

TEST(TextScanner, shows_unprintable_and_long_words_harmlessly) {
  EXPECT_EQ(shown("a\x01\xff"), "a??");
  EXPECT_EQ(shown(std::string(100, 'x')).size(), 63u);
}

}  // namespace
}  // namespace strataflow
