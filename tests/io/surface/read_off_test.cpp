#include "io/surface/read_off.h"

#include "io/mesh_damage.h"

namespace strataflow {
namespace {
using namespace support;

TEST(ReadOff, reads_polygons_and_leaves_colours_aside) {
  const InputData input = read_whole(read_off, text_of(own_sample("off/coloured.off")), "coloured.off");
  EXPECT_EQ(input.surfaces.points.size(), 4u);
  EXPECT_EQ(input.surfaces.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));
  ASSERT_EQ(input.warnings.size(), 1u);
  EXPECT_NE(input.warnings[0].what.find("COFF"), std::string::npos);
}

TEST(ReadOff, line_ends_mean_nothing_in_plain_off) {
  const InputData input = read_whole(read_off, "OFF 3 1 0 \n 0 0 0 1 0 0\n0 1\n0\n3 0 1 2\n", "a.off");
  EXPECT_EQ(input.surfaces.points[2], (Vec3{0, 1, 0}));
  EXPECT_TRUE(input.warnings.empty());
}

TEST(ReadOff, crlf_reads_like_lf) {
  const std::string text = text_of(own_sample("off/triangles.off"));
  EXPECT_EQ(archived(read_whole(read_off, with_crlf(text), "a.off")), archived(read_whole(read_off, text, "a.off")));
}

TEST(ReadOff, names_the_line_of_what_is_wrong) {
  const std::string text = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  expect_malformed(read_off(replaced(text, "1 0 0", "1 NaN 0"), "a.off"),
                   "a.off:4: a coordinate is not a finite number", "a.off");
  expect_malformed(read_off(replaced(text, "3 0 1 2", "3 0 1 3"), "a.off"), "point 3 does not exist; there are 3",
                   "a.off");
  expect_malformed(read_off(replaced(text, "3 0 1 2", "3 0 1 -1"), "a.off"), "point -1 does not exist", "a.off");
  expect_malformed(read_off(replaced(text, "3 1 0", "4000000000 1 0"), "a.off"), "which this file cannot hold",
                   "a.off");
  expect_malformed(read_off(replaced(text, "3 0 1 2", "4000000000 0 1 2"), "a.off"), "which this file cannot hold",
                   "a.off");
  expect_malformed(read_off(replaced(text, "OFF", "FFO"), "a.off"), "expected OFF", "a.off");
  expect_malformed(read_off("", "a.off"), "expected OFF", "a.off");
}

TEST(ReadOff, says_that_binary_off_is_not_read) {
  const Result<InputData> input = read_off("OFF BINARY\nxxxx", "a.off");
  ASSERT_FALSE(input);
  EXPECT_EQ(input.failure().code, FailureCode::unsupported);
}

TEST(ReadOff, survives_damage) {
  const std::string text = text_of(own_sample("off/triangles.off"));
  expect_truncation_is_named(read_off, text, "a.off");
  expect_damage_is_survived(read_off, text, "a.off");
}

}  // namespace
}  // namespace strataflow
