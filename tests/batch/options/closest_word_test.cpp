#include "batch/options/closest_word.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

TEST(ClosestWord, finds_what_was_meant) {
  EXPECT_EQ(closest_word("tetts", {"model", "tets", "hexes"}), "tets");
  EXPECT_EQ(closest_word("edge_lenght_m", {"sites", "edge_length_m"}), "edge_length_m");
}

TEST(ClosestWord, of_equally_near_ones_is_the_first) { EXPECT_EQ(closest_word("bat", {"cat", "hat"}), "cat"); }

TEST(ClosestWord, is_none_when_nothing_is_near) {
  EXPECT_EQ(closest_word("volume", {"sites", "mode"}), "");
  EXPECT_EQ(closest_word("xy", {"ab", "cd"}), "");  // two edits away from anything of two letters
  EXPECT_EQ(closest_word(std::string(100000, 'x'), {"mode"}), "");
}

TEST(Suggestion, lists_what_there_is_when_nothing_is_near) {
  EXPECT_EQ(suggestion("mod", {"mode"}), "did you mean 'mode'?");
  EXPECT_EQ(suggestion("volume", {"sites", "mode"}), "known: sites, mode");
}

}  // namespace
}  // namespace strataflow
