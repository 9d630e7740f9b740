#include "io/lines/read_pol.h"

#include "io/mesh_damage.h"

namespace strataflow {
namespace {
using namespace support;

TEST(ReadPol, lines_end_at_999_and_close_where_they_begin) {
  const InputData input = read_whole(
      read_pol, "0 0 1\n1 0 2\n999 999 999\n\n5 5 0\n6 5 0\n6 6 0\n5 5 0\r\n999.000000 999.000000 999.000000\n", "F1.pol");
  ASSERT_EQ(input.lines.size(), 2u);
  EXPECT_EQ(input.lines[0].points, (std::vector<Vec3>{{0, 0, 1}, {1, 0, 2}}));
  EXPECT_FALSE(input.lines[0].is_closed);
  EXPECT_TRUE(input.lines[1].is_closed);
  EXPECT_EQ(input.lines[1].points.size(), 3u);
  EXPECT_EQ(input.lines[1].name, "F1");
}

TEST(ReadPol, further_columns_are_ignored_and_told) {
  const InputData input = read_whole(read_pol, "0 0 1 7\n1 0 2 7\n", "a.pol");
  ASSERT_EQ(input.warnings.size(), 1u);
  EXPECT_EQ(input.warnings[0].kind, "ignored_columns");
}

TEST(ReadPol, names_the_line_of_what_is_wrong) {
  expect_malformed(read_pol("0 0 1\n1 0\n", "a.pol"), "expected three coordinates", "a.pol:2");
  expect_malformed(read_pol("0 0 1\n1 nan 0\n", "a.pol"), "not a finite number", "a.pol:2");
  expect_malformed(read_pol("999 999 999\n", "a.pol"), "no line in it", "a.pol");
  expect_malformed(read_pol("", "a.pol"), "no line in it", "a.pol");
}

TEST(ReadPol, reads_the_outline_and_the_sticks_of_drogon) {
  const auto outline = shared_data() / "drogon" / "outline.pol";
  if (!std::filesystem::exists(outline)) GTEST_SKIP() << outline << " is not there";
  const InputData input = read_whole(read_pol, text_of(outline), "outline.pol");
  ASSERT_EQ(input.lines.size(), 1u);
  EXPECT_TRUE(input.lines[0].is_closed);
  EXPECT_GT(read_whole(read_pol, text_of(shared_data() / "faultmaps/drogon-sticks/F1.pol"), "F1.pol").lines.size(), 10u);
}

}  // namespace
}  // namespace strataflow
