#include "io/lines/read_geo.h"

#include <algorithm>
#include <map>

#include "io/mesh_damage.h"
#include "io/read_input.h"

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

/// Files by name, as a reader of what is included.
IncludeReader files(std::map<std::string, std::string> texts) {
  return [texts = std::move(texts)](const std::string& name) -> Result<std::string> {
    const auto found = texts.find(name);
    if (found == texts.end()) return Failure{FailureCode::unreadable_file, name + ": not there", "put it there"};
    return found->second;
  };
}

TEST(ReadGeo, includes_files_relative_to_the_one_that_names_them) {
  const std::string text = text_of(own_sample("geo/two_layers.geo"));
  const std::string outer = "with_hole = 1;\nInclude \"sub/middle.geo\";\nb() = BoundingBox Surface{Surface{:}};\n"
                            "Dilate {{0, 0, 0}, {8/(b(3) - b(0)), 1, 1}}{Point{:};}\n";
  const Result<InputData> made =
      read_geo_including(outer, "a.geo", files({{"sub/middle.geo", "Include \"two.geo\";"}, {"sub/two.geo", text}}));
  ASSERT_TRUE(made) << describe(made.failure());
  ASSERT_EQ(made->lines.size(), 3u);
  const auto width = [](const Polyline& line) {
    const auto [low, high] = std::minmax_element(line.points.begin(), line.points.end(),
                                                 [](const Vec3& a, const Vec3& b) { return a.x < b.x; });
    return high->x - low->x;
  };
  EXPECT_DOUBLE_EQ(width(made->lines[0]), 8) << "stretched to 8";
}

TEST(ReadGeo, includes_that_cannot_be_followed_are_named) {
  const Result<InputData> missing = read_geo_including("\nInclude \"b.geo\";", "a.geo", files({}));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.failure().code, FailureCode::unreadable_file);
  EXPECT_EQ(missing.failure().what, "a.geo:2: includes 'b.geo': b.geo: not there");
  expect_malformed(read_geo_including("Include \"a.geo\";", "a.geo", files({{"a.geo", "Include \"a.geo\";"}})),
                   "more than 16 deep, 'a.geo' among them", "a.geo");
  expect_malformed(read_geo_including("Include \"b.geo\";", "a.geo", files({{"b.geo", "\nx = y;"}})), "found 'y'", "b.geo:2");
  const Result<InputData> alone = read_geo("Include \"b.geo\";", "a.geo");
  ASSERT_FALSE(alone);
  EXPECT_EQ(alone.failure().code, FailureCode::unsupported);
}

TEST(ReadGeo, reads_the_large_spe11_section_beside_the_small_one) {
  const auto path = shared_data() / "section2d" / "spe11b.geo";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const Result<InputData> input = read_input(path);
  ASSERT_TRUE(input) << describe(input.failure());
  Vec3 high{};
  for (const Polyline& line : input->lines)
    for (const Vec3& p : line.points) high = {std::max(high.x, p.x), std::max(high.y, p.y), 0};
  EXPECT_NEAR(high.x, 8400, 1e-9);
  EXPECT_NEAR(high.y, 1200, 1e-9);
  ASSERT_EQ(included_texts(path).size(), 1u);
  EXPECT_EQ(included_texts(path)[0], text_of(path.parent_path() / "spe11a.geo"));
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
