#include "io/lines/read_fault_map.h"

#include "io/mesh_damage.h"

namespace strataflow {
namespace {
using namespace support;

TEST(ReadFaultMap, an_outline_and_faults_with_their_numbers) {
  const InputData input = read_whole(read_fault_map, "B 3\n0 0\n4 0\n0 4\nF 2\n1 1\n2 1\nF 2\n1 2\n2 2\n", "a.txt");
  ASSERT_EQ(input.lines.size(), 3u);
  EXPECT_EQ(input.lines[0].role, Role::outline);
  EXPECT_TRUE(input.lines[0].is_closed);
  EXPECT_EQ(input.lines[2].name, "F2");
  EXPECT_EQ(input.lines[2].role, Role::fault);
  EXPECT_EQ(input.lines[2].points, (std::vector<Vec3>{{1, 2, 0}, {2, 2, 0}}));
}

TEST(ReadFaultMap, names_the_line_of_what_is_wrong) {
  expect_malformed(read_fault_map("C 2\n0 0\n1 1\n", "a.txt"), "expected B or F", "a.txt:1");
  expect_malformed(read_fault_map("F 3\n0 0\n1 1\n", "a.txt"), "3 points announced, 2 found", "a.txt:1");
  expect_malformed(read_fault_map("F 4000000000\n0 0\n", "a.txt"), "cannot hold", "a.txt:1");
  expect_malformed(read_fault_map("F 2\n0 0\n1 inf\n", "a.txt"), "expected two coordinates", "a.txt:3");
  expect_malformed(read_fault_map("", "a.txt"), "no line in it", "a.txt");
}

TEST(ReadFaultMap, reads_branets) {
  const auto path = shared_data() / "faultmaps" / "branets.txt";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const InputData input = read_whole(read_fault_map, text_of(path), "branets.txt");
  EXPECT_EQ(input.lines.size(), 22u);
  EXPECT_EQ(input.lines[0].points.size(), 41u);
}

}  // namespace
}  // namespace strataflow
