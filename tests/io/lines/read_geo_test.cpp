#include "io/lines/read_geo.h"

#include "io/mesh_damage.h"

namespace strataflow {
namespace {
using namespace support;

TEST(ReadGeo, a_section_has_an_outline_holes_and_curves_called_after_what_lies_beside_them) {
  const InputData input = read_whole(read_geo, text_of(own_sample("geo/two_layers.geo")), "two_layers.geo");
  ASSERT_EQ(input.lines.size(), 3u);
  EXPECT_EQ(input.lines[0].role, Role::outline);
  EXPECT_TRUE(input.lines[0].is_closed);
  EXPECT_EQ(input.lines[0].points.size(), 6u);
  EXPECT_EQ(input.lines[1].role, Role::hole);
  EXPECT_EQ(input.lines[1].points.size(), 3u);
  EXPECT_EQ(input.lines[2].name, "sand | shale");
  EXPECT_EQ(input.lines[2].points.size(), 3u) << "both lines as one curve";
  ASSERT_EQ(input.warnings.size(), 1u);
  EXPECT_EQ(input.warnings[0].kind, "ignored_group");
}

TEST(ReadGeo, conditions_are_followed) {
  const std::string text = replaced(text_of(own_sample("geo/two_layers.geo")), "with_hole = 1", "with_hole = 0");
  EXPECT_EQ(read_whole(read_geo, text, "a.geo").lines[2].name, "sand | surface 2");
}

TEST(ReadGeo, names_the_line_of_what_is_wrong) {
  const std::string text = text_of(own_sample("geo/two_layers.geo"));
  expect_malformed(read_geo(replaced(text, "Line(8) = {3, 7}", "Line(8) = {3, 99}"), "a.geo"), "two different points", "a.geo:8");
  expect_malformed(read_geo(replaced(text, "c = h *", "c = q *"), "a.geo"), "expected a number, found 'q'", "a.geo:3");
  expect_malformed(read_geo(replaced(text, "c/2}", "c/2"), "a.geo"), "expected '}'", "a.geo:4");
  expect_malformed(read_geo(replaced(text, "{0, 0, 0, c}", "{0, 1/0, 0, c}"), "a.geo"), "not a finite number", "a.geo:4");
  expect_malformed(read_geo(replaced(text, "{1, 3};", "{1, 9};"), "a.geo"), "curve loop 9, which is not there", "a.geo");
  expect_malformed(read_geo(replaced(text, "{7, -8, 3", "{77, -8, 3"), "a.geo"), "line 77, which is not there", "a.geo");
  expect_malformed(read_geo(replaced(replaced(text, "EndIf", ""), "with_hole = 1", "with_hole = 0"), "a.geo"),
                   "If without EndIf", "a.geo");
  expect_malformed(read_geo("", "a.geo"), "no line in it", "a.geo");
  const Result<InputData> arc = read_geo("Point(1)={0,0,0};\nCircle(1) = {1, 2, 3};", "a.geo");
  ASSERT_FALSE(arc);
  EXPECT_EQ(arc.failure().code, FailureCode::unsupported);
  EXPECT_EQ(arc.failure().what, "a.geo:2: 'Circle' is not read");
}

TEST(ReadGeo, reads_the_spe11_section) {
  const auto path = shared_data() / "section2d" / "spe11a.geo";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const InputData input = read_whole(read_geo, text_of(path), "spe11a.geo");
  std::size_t outlines = 0, segments = 0;
  for (const Polyline& line : input.lines) {
    outlines += line.role == Role::outline;
    segments += line.points.size() - (line.is_closed ? 0 : 1);
  }
  EXPECT_EQ(outlines, 1u);
  EXPECT_EQ(segments, 318u) << "every line of the file is in one curve";
}

}  // namespace
}  // namespace strataflow
