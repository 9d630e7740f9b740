#include "io/surface/read_stl.h"

#include "io/bytes/byte_order.h"
#include "io/mesh_damage.h"

namespace strataflow {
namespace {
using namespace support;

const std::string two_solids =
    "solid lower face\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n  "
    "endloop\n endfacet\nendsolid lower face\n"
    "solid upper\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 1\n   vertex 1 0 1\n   vertex 0 1 1\n  endloop\n "
    "endfacet\nendsolid\n";

TEST(ReadStl, a_solid_is_a_patch_and_points_stay_as_they_are) {
  const InputData input = read_whole(read_stl, two_solids, "a.stl");
  EXPECT_EQ(input.surfaces.points.size(), 6u);
  EXPECT_EQ(input.surfaces.triangle_patch, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(input.surfaces.entities[0].name, "lower face");
  EXPECT_EQ(input.surfaces.points[5], (Vec3{0, 1, 1}));
}

TEST(ReadStl, ascii_and_binary_hold_the_same) {
  InputData ascii = read_whole(read_stl, text_of(own_sample("stl/ascii.stl")), "a.stl");
  InputData binary = read_whole(read_stl, text_of(own_sample("stl/binary.stl")), "a.stl");
  ascii.surfaces.entities = binary.surfaces.entities;
  EXPECT_EQ(archived(ascii), archived(binary));
  EXPECT_EQ(binary.surfaces.triangles.size(), 2u);
}

TEST(ReadStl, a_binary_file_that_starts_with_solid_is_told_by_its_size) {
  std::string bytes = text_of(own_sample("stl/binary.stl"));
  bytes.replace(0, 5, "solid");
  EXPECT_EQ(read_whole(read_stl, bytes, "a.stl").surfaces.triangles.size(), 2u);
}

TEST(ReadStl, crlf_reads_like_lf) {
  EXPECT_EQ(archived(read_whole(read_stl, with_crlf(two_solids), "a.stl")),
            archived(read_whole(read_stl, two_solids, "a.stl")));
}

TEST(ReadStl, names_what_is_wrong) {
  expect_malformed(read_stl(replaced(two_solids, "vertex 1 0 0", "vertex nan 0 0"), "a.stl"),
                   "a.stl:5: a coordinate is not a finite number", "a.stl");
  expect_malformed(read_stl(replaced(two_solids, "   vertex 1 0 0\n", ""), "a.stl"), "a facet needs three vertices",
                   "a.stl");
  expect_malformed(read_stl(replaced(two_solids, "endloop", "endlop"), "a.stl"), "expected 'endloop', found 'endlop'",
                   "a.stl");
  expect_malformed(read_stl("", "a.stl"), "neither ascii STL", "a.stl");
  std::string bytes = text_of(own_sample("stl/binary.stl"));
  std::string huge;
  store_number<std::uint32_t>(huge, 4000000000u);
  expect_malformed(read_stl(std::string(bytes).replace(80, 4, huge), "a.stl"),
                   "binary STL of 4000000000 facets should have", "a.stl");
  std::string not_a_number;
  store_number<std::uint32_t>(not_a_number, 0x7fc00000u);
  expect_malformed(read_stl(std::string(bytes).replace(96, 4, not_a_number), "a.stl"), "not a finite number", "a.stl");
}

TEST(ReadStl, survives_damage) {
  expect_truncation_is_named(read_stl, text_of(own_sample("stl/ascii.stl")), "a.stl");
  expect_truncation_is_named(read_stl, text_of(own_sample("stl/binary.stl")), "a.stl");
  expect_damage_is_survived(read_stl, text_of(own_sample("stl/binary.stl")), "a.stl");
  expect_damage_is_survived(read_stl, two_solids, "a.stl");
}

TEST(ReadStl, reads_the_arrangement_tests) {
  STRATAFLOW_NEEDS_SHARED_DATA();
  EXPECT_EQ(read_whole(read_stl, text_of(shared_data() / "arrangement/three_cubes.stl"), "three_cubes.stl")
                .surfaces.triangles.size(),
            36u);
  EXPECT_EQ(read_whole(read_stl, text_of(shared_data() / "arrangement/two_spheres.stl"), "two_spheres.stl")
                .surfaces.triangles.size(),
            1600u);
  EXPECT_EQ(
      read_whole(read_stl, text_of(shared_data() / "arrangement/40509.stl"), "40509.stl").surfaces.triangles.size(),
      14370u);
}

}  // namespace
}  // namespace strataflow
