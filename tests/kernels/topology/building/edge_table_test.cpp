#include "kernels/topology/building/edge_table.h"

#include <gtest/gtest.h>

#include "base/id.h"
#include "kernels/topology/building/build_lines.h"
#include "kernels/topology/building/build_surfaces.h"
#include "kernels/topology/union_find.h"
#include "kernels/topology/building/weld_points.h"

namespace strataflow {
namespace {

/// Two triangles over the edge 0–1 and a third that hangs on the vertex 3.
const std::vector<Triangle> fan{{0, 1, 2}, {1, 0, 3}, {3, 4, 5}};

TEST(EdgeTable, lists_every_edge_once_with_its_half_edges) {
  const EdgeTable table = build_edge_table(6, fan);
  EXPECT_EQ(table.edge_count(), 8u);
  const std::uint32_t shared = find_edge(table, 1, 0);
  ASSERT_NE(shared, no_index);
  EXPECT_EQ(std::vector<std::uint32_t>(table.around(shared).begin(), table.around(shared).end()),
            (std::vector<std::uint32_t>{0, 3}));
  EXPECT_EQ(table.edge_of[0], shared);
  EXPECT_EQ(find_edge(table, 2, 3), no_index);
}

TEST(EdgeTable, is_empty_without_triangles) { EXPECT_EQ(build_edge_table(0, {}).edge_count(), 0u); }

TEST(WeldPoints, equal_bits_and_both_zeros_are_one_point) {
  const WeldedPoints welded = weld_points({{0, 1, 2}, {-0.0, 1, 2}, {0, 1, 2.0000000000000004}, {0, 1, 2}});
  EXPECT_EQ(welded.id, (std::vector<std::uint32_t>{0, 0, 1, 0}));
  EXPECT_EQ(welded.source, (std::vector<std::uint32_t>{0, 2}));
}

TEST(UnionFind, the_smallest_member_speaks_for_its_set) {
  UnionFind sets(6);
  sets.unite(5, 3);
  sets.unite(3, 4);
  sets.unite(0, 1);
  EXPECT_EQ(sets.find(5), 3u);
  EXPECT_EQ(sets.find(4), 3u);
  EXPECT_EQ(sets.find(1), 0u);
  EXPECT_EQ(sets.find(2), 2u);
}

TEST(BuildSurfaces, a_change_of_patch_is_a_feature_and_orientation_follows_the_majority) {
  // A strip of four triangles, the third turned over, the fourth of another patch.
  const std::vector<Triangle> strip{{0, 1, 2}, {2, 1, 3}, {3, 2, 4}, {4, 3, 5}};
  const EdgeTable edges = build_edge_table(6, strip);
  const SurfacePartition partition = build_surfaces(edges, strip, {0, 0, 0, 1});
  EXPECT_EQ(partition.surface_count, 2u);
  EXPECT_EQ(partition.surface_of, (std::vector<std::uint32_t>{0, 0, 0, 1}));
  EXPECT_TRUE(partition.is_feature[find_edge(edges, 3, 4)]);
  EXPECT_FALSE(partition.is_feature[find_edge(edges, 1, 2)]);
  EXPECT_EQ(partition.is_flipped, (std::vector<char>{0, 0, 1, 0}));
  EXPECT_TRUE(partition.non_orientable.empty());
}

TEST(BuildLines, two_patches_side_by_side_share_one_line_between_two_corners) {
  const std::vector<Triangle> pair{{0, 1, 2}, {2, 1, 3}};
  const EdgeTable edges = build_edge_table(4, pair);
  const SurfacePartition partition = build_surfaces(edges, pair, {0, 1});
  const LineNetwork network = build_lines(edges, partition.is_feature, partition.surface_of, 4);
  ASSERT_EQ(network.corners.size(), 2u);
  EXPECT_EQ(network.corners[0].vertex, 1u);
  EXPECT_EQ(network.corners[1].vertex, 2u);
  EXPECT_EQ(network.lines.size(), 3u);  // two free borders and the contact
}

TEST(BuildLines, the_border_of_a_free_sheet_is_one_closed_line) {
  const std::vector<Triangle> sheet{{0, 1, 2}, {2, 1, 3}};
  const EdgeTable edges = build_edge_table(4, sheet);
  const SurfacePartition partition = build_surfaces(edges, sheet, {0, 0});
  const LineNetwork network = build_lines(edges, partition.is_feature, partition.surface_of, 4);
  ASSERT_EQ(network.lines.size(), 1u);
  EXPECT_TRUE(network.lines[0].is_closed());
  EXPECT_TRUE(network.lines[0].is_free_border());
  EXPECT_EQ(network.lines[0].vertices, (std::vector<std::uint32_t>{0, 1, 3, 2}));
}

}  // namespace
}  // namespace strataflow
