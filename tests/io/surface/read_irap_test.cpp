#include "io/surface/read_irap.h"

#include <bit>

#include "io/mesh_damage.h"
#include "io/read_input.h"

namespace strataflow {
namespace {
using namespace support;

/// 3 columns, 2 rows, turned by 90°: x runs north, y runs west.
const std::string header = "-996 2 10 20\n0 20 0 20\n3 90 100 200\n0 0 0 0 0 0 0\n";

void put(std::string& bytes, std::uint32_t word) {
  for (const int shift : {24, 16, 8, 0}) bytes.push_back(static_cast<char>(word >> shift));
}
void put(std::string& bytes, float number) { put(bytes, std::bit_cast<std::uint32_t>(number)); }

std::string binary_grid() {
  std::string bytes;
  const auto record = [&](auto... values) {
    put(bytes, static_cast<std::uint32_t>(4 * sizeof...(values)));
    (put(bytes, values), ...);
    put(bytes, static_cast<std::uint32_t>(4 * sizeof...(values)));
  };
  record(static_cast<std::uint32_t>(-996), 2u, 0.0f, 20.0f, 0.0f, 20.0f, 10.0f, 20.0f);
  record(3u, 90.0f, 100.0f, 200.0f);
  record(0u, 0u, 0u, 0u, 0u, 0u, 0u);
  record(1.0f, 2.0f, 3.0f);
  record(4.0f, 5.0f, 1e30f);
  return bytes;
}

TEST(ReadIrap, a_turned_grid_of_depths_is_a_surface_with_a_hole_where_it_is_undefined) {
  for (const std::string& bytes : {header + "1 2 3 4\n5 9999900.0\n", binary_grid()}) {
    const InputData input = read_whole(read_irap, bytes, "top.gri");
    ASSERT_EQ(input.surfaces.points.size(), 5u);
    EXPECT_EQ(input.surfaces.triangles.size(), 3u) << "one cell lacks a corner";
    EXPECT_EQ(input.surfaces.entities[0].name, "top");
    const auto at = [&](std::size_t i) { return input.surfaces.points[i] + input.surfaces.local_origin; };
    EXPECT_LT(length(at(1) - Vec3{100, 210, -2}), 1e-9);
    EXPECT_LT(length(at(3) - Vec3{80, 200, -4}), 1e-9);
    ASSERT_EQ(input.warnings.size(), 1u);
    EXPECT_EQ(input.warnings[0].kind, "taken_for_depths");
  }
}

TEST(ReadIrap, numbers_that_are_never_positive_are_elevations) {
  const InputData input = read_whole(read_irap, header + "-1 -2 -3 -4 -5 -6\n", "top.gri");
  EXPECT_TRUE(input.warnings.empty());
  EXPECT_EQ((input.surfaces.points[5] + input.surfaces.local_origin).z, -6);
}

TEST(ReadIrap, names_what_is_wrong) {
  expect_malformed(read_irap("", "a.gri"), "header", "a.gri");
  expect_malformed(read_irap("-995 2 10 20\n0 20 0 20\n3 90 100 200\n0 0 0 0 0 0 0\n1 2 3 4 5 6", "a.gri"),
                   "no header of a grid", "a.gri");
  expect_malformed(read_irap(header + "1 2 3\n4 x\n", "a.gri"), "depth 5 of 6", "a.gri:6");
  expect_malformed(read_irap("-996 2e9 10 20\n0 20 0 20\n3e9 90 0 0\n0 0 0 0 0 0 0\n1", "a.gri"), "do not fit",
                   "a.gri");
  const std::string whole = binary_grid();
  for (std::size_t size = 8; size + 1 < whole.size(); size += 7)
    EXPECT_FALSE(read_irap(whole.substr(0, size), "a.gri")) << size;
  expect_malformed(read_irap(header + "1 2 3 9999900 9999900 9999900\n", "a.gri"), "no cell", "a.gri");
}

TEST(ReadIrap, reads_the_horizons_of_drogon_as_their_ply_says) {
  const auto folder = shared_data() / "drogon";
  if (!std::filesystem::exists(folder / "01_topvolantis.gri")) GTEST_SKIP() << folder << " is not there";
  const auto grid = read_input(folder / "01_topvolantis.gri"), ply = read_input(folder / "01_topvolantis.ply.gz");
  ASSERT_TRUE(grid) << describe(grid.failure());
  ASSERT_TRUE(ply);
  ASSERT_EQ(grid->surfaces.points.size(), ply->surfaces.points.size());
  EXPECT_EQ(grid->surfaces.triangles.size(), ply->surfaces.triangles.size());
  double most = 0;
  for (std::size_t i = 0; i < grid->surfaces.points.size(); ++i)
    most = std::max(most, length(grid->surfaces.points[i] + grid->surfaces.local_origin - ply->surfaces.points[i] -
                                 ply->surfaces.local_origin));
  EXPECT_LT(most, 0.1) << "metres; the steps are single precision";
}

}  // namespace
}  // namespace strataflow
