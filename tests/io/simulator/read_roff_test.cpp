#include "io/simulator/read_roff.h"

#include "io/bytes/byte_order.h"
#include "io/mesh_damage.h"

namespace strataflow {
namespace {
using namespace support;

/// Two cells side by side, a fault of 5 m between them: nodes go from the bottom up, J within I.
const std::string ascii =
    "roff-asc\n#ROFF file#\ntag filedata\nint byteswaptest 1\nchar filetype \"grid\"\nendtag\n"
    "tag dimensions\nint nX 2\nint nY 1\nint nZ 1\nendtag\n"
    "tag translate\nfloat xoffset 500\nfloat yoffset 0\nfloat zoffset 0\nendtag\n"
    "tag scale\nfloat xscale 1\nfloat yscale 1\nfloat zscale -1\nendtag\n"
    "tag subgrids\narray int nLayers 1\n 1\nendtag\n"
    "tag cornerLines\narray float data 36\n"
    " 0 0 -1010 0 0 -1000  0 100 -1010 0 100 -1000\n 100 0 -1010 100 0 -1000  100 100 -1010 100 100 -1000\n"
    " 200 0 -1010 200 0 -1000  200 100 -1010 200 100 -1000\nendtag\n"
    "tag zvalues\narray byte splitEnz 12\n 1 1 1 1 4 4 4 4 1 1 1 1\n"
    "array float data 24\n -1010 -1000 -1010 -1000\n"
    " -1010 -1015 -1010 -1015 -1000 -1005 -1000 -1005 -1010 -1015 -1010 -1015 -1000 -1005 -1000 -1005\n"
    " -1015 -1005 -1015 -1005\nendtag\n"
    "tag active\narray bool data 2\n 1 1\nendtag\ntag eof\nendtag\n";

/// The same bytes as a machine of either byte order would write them.
std::string binary(bool swaps) {
  std::string bytes;
  const auto word = [&](const std::string& text) { bytes += text + '\0'; };
  const auto number = [&](auto value) {
    std::string own;
    store_number(own, value);
    if (swaps) std::reverse(own.begin(), own.end());
    bytes += own;
  };
  const auto tag = [&](const std::string& name) { word("tag"), word(name); };
  const auto one = [&](const std::string& type, const std::string& name, double value) {
    word(type), word(name);
    if (type == "int")
      number(static_cast<std::int32_t>(value));
    else
      number(static_cast<float>(value));
  };
  word("roff-bin"), word("#ROFF file#");
  tag("filedata"), one("int", "byteswaptest", 1), word("char"), word("filetype"), word("grid"), word("endtag");
  tag("dimensions"), one("int", "nX", 1), one("int", "nY", 1), one("int", "nZ", 1), word("endtag");
  tag("cornerLines"), word("array"), word("float"), word("data"), number(std::int32_t{24});
  for (const double x : {0.0, 100.0})
    for (const double y : {0.0, 100.0})
      for (const double z : {-1010.0, -1000.0})
        number(static_cast<float>(x)), number(static_cast<float>(y)), number(static_cast<float>(z));
  word("endtag");
  tag("zvalues"), word("array"), word("byte"), word("splitEnz"), number(std::int32_t{8});
  bytes += std::string(8, '\1');
  word("array"), word("float"), word("data"), number(std::int32_t{8});
  for (int pillar = 0; pillar < 4; ++pillar) number(-1010.0f), number(-1000.0f);
  word("endtag"), tag("eof"), word("endtag");
  return bytes;
}

TEST(ReadRoff, tells_the_four_heights_around_a_node_apart) {
  const InputData input = read_whole(read_roff, ascii, "a.roff");
  ASSERT_EQ(input.volume.cell_count(), 2u);
  EXPECT_EQ(input.volume.points.size(), 16u);
  double lowest[2] = {0, 0};
  for (std::size_t n = 0; n < 16; ++n)
    lowest[n / 8] = std::min(lowest[n / 8], input.volume.points[input.volume.cell_vertices[n]].z);
  EXPECT_EQ(lowest[0], -1010);
  EXPECT_EQ(lowest[1], -1015);
  EXPECT_EQ(input.volume.points[0].x, 500);
}

TEST(ReadRoff, reads_both_byte_orders) {
  for (const bool swaps : {false, true}) {
    const InputData input = read_whole(read_roff, binary(swaps), "a.roff");
    ASSERT_EQ(input.volume.points.size(), 8u);
    EXPECT_EQ(input.volume.points[7], (Vec3{100, 100, -1000}));
  }
}

TEST(ReadRoff, names_what_is_wrong) {
  const auto wrong = [](const std::string& from, const std::string& to, const std::string& words) {
    expect_malformed(read_roff(replaced(ascii, from, to), "a.roff"), words, "a.roff");
  };
  wrong("roff-asc", "ruff-asc", "this is no ROFF file");
  wrong("int nX 2", "int nX 0", "there is no sound dimensions.nX");
  wrong("int nX 2", "int nX 3", "cornerLines has not six numbers per pillar");
  wrong("data 24\n", "data 2000000000\n", "which this file cannot hold");
  wrong("1 1 1 1 4 4", "1 1 1 1 3 4", "splitEnz and zvalues do not fit");
  wrong("byte splitEnz 12\n 1", "byte splitEnz 11\n", "splitEnz has not a number per node");
  wrong("array bool data 2\n 1", "array bool data 1\n", "active has not a value per cell");
  wrong("-1005 -1000 -1005 -1010", "-1005 nan -1005 -1010", "a height is not a finite number");
}

TEST(ReadRoff, survives_damage) {
  expect_damage_is_survived(read_roff, ascii, "a.roff");
  expect_damage_is_survived(read_roff, binary(false), "a.roff");
  expect_truncation_is_named(read_roff, binary(false), "a.roff", true);
}

TEST(ReadRoff, reads_the_grid_that_the_owners_of_drogon_built) {
  const auto file = shared_data() / "drogon/reference_simgrid.roff";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "there is no " << file;
  const auto grid = read_roff_grid(text_of(file), "reference_simgrid.roff");
  ASSERT_TRUE(grid) << describe(grid.failure());
  EXPECT_EQ(grid->grid.size, (std::array<std::uint32_t, 3>{46, 73, 32}));
  EXPECT_EQ(grid->layer_zone.size(), 32u);
  const InputData input = read_whole(read_roff, text_of(file), "reference_simgrid.roff");
  EXPECT_EQ(input.volume.cell_count(), 73419u);
}

}  // namespace
}  // namespace strataflow
