#include "io/input/input_builder.h"

#include "io/mesh_damage.h"

namespace strataflow {
namespace {
using namespace support;

TEST(InputBuilder, the_stem_is_the_name_without_folder_and_endings) {
  EXPECT_EQ(stem_of("some/where/01_top.ply.gz"), "01_top");
  EXPECT_EQ(stem_of("cube.obj"), "cube");
  EXPECT_EQ(stem_of("noending"), "noending");
}

TEST(InputBuilder, a_closed_line_does_not_repeat_its_first_point) {
  InputBuilder built("a.obj");
  built.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  const std::uint32_t ring[] = {0, 1, 2, 0};
  built.add_line(ring, 4, "outline");
  const Result<InputData> input = std::move(built).finish();
  ASSERT_TRUE(input);
  EXPECT_TRUE(input->lines.at(0).is_closed);
  EXPECT_EQ(input->lines[0].points.size(), 3u);
}

TEST(InputBuilder, segments_join_only_within_one_name) {
  InputBuilder built("a.msh");
  built.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  built.add_segment(0, 1, "a");
  built.add_segment(1, 2, "a");
  built.add_segment(2, 3, "b");
  const Result<InputData> input = std::move(built).finish();
  ASSERT_TRUE(input);
  ASSERT_EQ(input->lines.size(), 2u);
  EXPECT_EQ(input->lines[0].points.size(), 3u);
}

TEST(InputBuilder, regions_are_numbered_by_ascending_label) {
  InputBuilder built("a.mesh");
  built.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::uint32_t tet[] = {0, 1, 2, 3};
  for (int i = 0; i < 3; ++i) built.add_cell(CellType::tetrahedron, tet, 0);
  built.name_regions({9, -4, 9}, [](std::int64_t label) { return "r" + std::to_string(label); });
  const Result<InputData> input = std::move(built).finish();
  ASSERT_TRUE(input);
  EXPECT_EQ(input->volume.cell_region, (std::vector<std::int32_t>{1, 0, 1}));
  EXPECT_EQ(input->volume.region_names, (std::vector<std::string>{"r-4", "r9"}));
}

TEST(InputBuilder, a_point_out_of_range_or_not_finite_is_named) {
  InputBuilder out("a.obj");
  out.points = {{0, 0, 0}, {1, 0, 0}};
  const std::uint32_t triangle[] = {0, 1, 2};
  out.add_polygon(triangle, 3, out.patch("a"));
  expect_malformed(std::move(out).finish(), "triangle 1 refers to point 3 of 2", "a.obj");
  InputBuilder infinite("a.obj");
  infinite.points = {{0, 0, 0}, {1, std::numeric_limits<double>::infinity(), 0}};
  expect_malformed(std::move(infinite).finish(), "point 2 has a coordinate that is not a finite number", "a.obj");
  expect_malformed(InputBuilder("a.obj").finish(), "holds no points", "a.obj");
}

}  // namespace
}  // namespace strataflow
