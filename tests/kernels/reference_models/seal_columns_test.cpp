#include "kernels/reference_models/seal_columns.h"

#include <gtest/gtest.h>

#include "kernels/reference_models/soup_topology.h"

namespace strataflow {
namespace {

using namespace testing_support;

/// A unit box of two blocks, west and east of a vertical fault at x = 0.5; one horizon with a throw between them, and
/// (if asked for) a sloping cutter that it meets.
class TwoBlocks final : public ColumnModel {
 public:
  TwoBlocks(double throw_m, bool is_cut) : throw_m_(throw_m) {
    box = {{0, 0, 0}, {1, 1, 1}};
    entities = {{"H", Role::horizon}, {"F", Role::fault}, {"Box", Role::boundary}, {"E", Role::unconformity}};
    std::vector<Level> levels{{2, Cut::plain}, {0, is_cut ? Cut::below_cutter : Cut::plain}};
    if (is_cut) levels.push_back({3, Cut::cutter});
    levels.push_back({2, Cut::plain});
    blocks = {levels, levels};
  }
  Vec3 at(std::uint32_t, const MapPoint& p, double z_m) const override { return {p.a, p.b, z_m}; }
  double height(std::uint32_t block, std::uint32_t level, const MapPoint& p) const override {
    if (level == 0) return 0;
    if (level + 1 == blocks[block].size()) return 1;
    return level == 1 ? 0.5 - (block == 1 ? throw_m_ : 0) : 0.3 + 0.5 * p.b;
  }
  ColumnMap map(double) const override {
    ColumnMap map;
    for (const double y : {0.0, 1.0})
      for (const double x : {0.0, 0.5, 1.0}) map.points.push_back({x, y, 0});
    map.triangles = {{{0, 1, 4}, 0}, {{0, 4, 3}, 0}, {{1, 2, 5}, 1}, {{1, 5, 4}, 1}};
    for (const auto& ends : {std::array<std::uint32_t, 2>{0, 1}, {1, 2}, {2, 5}, {5, 4}, {4, 3}, {3, 0}})
      map.walls.push_back({ends, 2, {0, 0}, {1, 1}});
    map.walls.push_back({{1, 4}, 1, {0, 0}, {1, 1}});
    return map;
  }
  TriangleSoup raw_surfaces(double, double) const override { return {}; }

 private:
  double throw_m_;
};

std::vector<double> volumes(const ColumnModel& model) { return topology_of(seal_columns(model, 10)).region_volumes; }

TEST(SealColumns, makes_a_region_per_block_and_layer) {
  const auto regions = volumes(TwoBlocks(0.2, false));
  ASSERT_EQ(regions.size(), 4u);
  EXPECT_NEAR(regions[0], 0.35, 1e-15);
  EXPECT_NEAR(regions[1], 0.25, 1e-15);
  EXPECT_NEAR(regions[2], 0.25, 1e-15);
  EXPECT_NEAR(regions[3], 0.15, 1e-15);
}

TEST(SealColumns, joins_a_horizon_across_a_fault_without_throw) {
  const TriangleSoup soup = seal_columns(TwoBlocks(0, false), 10);
  EXPECT_EQ(piece_count(soup, 0), 1u);
  EXPECT_EQ(topology_of(soup).region_volumes.size(), 4u);
}

TEST(SealColumns, ends_levels_on_the_cutter_along_shared_contacts) {
  // The cutter rises from 0.3 to 0.8: the horizon at 0.5 exists where y > 0.4, the one at 0.4 where y > 0.2.
  for (const double thrown : {0.0, 0.1}) {
    const TriangleSoup soup = seal_columns(TwoBlocks(thrown, true), 10);
    const SoupTopology topology = topology_of(soup);
    EXPECT_TRUE(topology.free_edges.empty());
    ASSERT_EQ(topology.region_volumes.size(), 6u);
    EXPECT_NEAR(std::accumulate(topology.region_volumes.begin(), topology.region_volumes.end(), 0.0), 1, 1e-14);
    double first = 1;
    for (const Vec3& p : points_of(soup, "H")) first = std::min(first, p.y);
    EXPECT_NEAR(first, thrown > 0 ? 0.2 : 0.4, 1e-12);
  }
}

TEST(SealColumns, divides_high_walls_into_edges_of_the_length_asked_for) {
  const TwoBlocks model(0.2, false);
  EXPECT_GT(seal_columns(model, 0.1).points.size(), seal_columns(model, 10).points.size());
}

}  // namespace
}  // namespace strataflow
