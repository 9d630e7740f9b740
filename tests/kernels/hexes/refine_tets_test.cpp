#include "kernels/hexes/refine_tets.h"

#include <gtest/gtest.h>

#include "kernels/hexes/level_ranges.h"
#include "kernels/hexes/tet_models.h"

namespace strataflow {
namespace {

double volume_m3(const LabelledTets& tets) {
  double six = 0;
  for (const Tet& t : tets.tets)
    six += support::six_volumes(tets.points[t[0]], tets.points[t[1]], tets.points[t[2]], tets.points[t[3]]);
  return six / 6;
}

struct Labelled {
  LabelledTets tets;
  StratigraphicLevels levels;
};

Labelled labelled(const ColumnModel& columns, double edge_m) {
  Labelled result;
  result.tets = *label_tets(support::filled(columns, edge_m));
  result.levels = *find_stratigraphic_levels(result.tets);
  return result;
}

TEST(RefineTets, leaves_no_tetrahedron_with_all_corners_on_one_level) {
  Labelled model = labelled(*vertical_faults(2, true), 100);
  const auto flat_count = [&] {
    const FaultSplit split = split_along_faults(model.tets);
    const std::vector<LevelRange> ranges = level_ranges(model.tets, model.levels, split);
    return std::count_if(split.tets.begin(), split.tets.end(), [&](const Tet& tet) {
      return std::all_of(tet.begin(), tet.end(), [&](std::uint32_t c) {
        return !ranges[c].is_empty() && ranges[c].low == ranges[tet[0]].low;
      });
    });
  };
  EXPECT_GT(flat_count(), 0);
  EXPECT_GT(split_level_chords(model.tets, model.levels), 0u);
  EXPECT_EQ(flat_count(), 0);
  EXPECT_EQ(split_level_chords(model.tets, model.levels), 0u);
  EXPECT_EQ(model.levels.unit.size(), model.tets.tets.size());
  EXPECT_NEAR(volume_m3(model.tets) / (1600.0 * 1200 * 400), 1, 1e-12);
}

TEST(RefineTets, gives_each_tetrahedron_one_wall_at_most) {
  Labelled model = labelled(*dipping_faults(std::array{0.577}, 15), 100);
  EXPECT_GT(separate_walls(model.tets, model.levels), 0u);
  for (std::uint32_t t = 0; t < model.tets.tets.size(); ++t) {
    int walls = 0;
    for (std::uint32_t k = 0; k < 4; ++k) walls += model.tets.is_wall(4 * t + k) ? 1 : 0;
    EXPECT_LE(walls, 1);
  }
  EXPECT_NEAR(volume_m3(model.tets) / (2000.0 * 1000 * 400), 1, 1e-12);
}

TEST(RefineTets, leaves_no_tetrahedron_with_all_corners_on_walls) {
  Labelled model = labelled(*dipping_faults(std::array{0.577}, 15), 100);
  EXPECT_GT(split_wall_chords(model.tets, model.levels), 0u);
  EXPECT_EQ(split_wall_chords(model.tets, model.levels), 0u);
  std::vector<char> is_on_wall(model.tets.points.size(), 0);
  for (std::uint32_t face = 0; face < model.tets.facet_of.size(); ++face)
    if (model.tets.is_wall(face))
      for (const std::uint32_t p : face_vertices(model.tets.tets[face / 4], face % 4)) is_on_wall[p] = 1;
  for (const Tet& tet : model.tets.tets)
    EXPECT_FALSE(std::all_of(tet.begin(), tet.end(), [&](std::uint32_t p) { return is_on_wall[p]; }));
}

TEST(RefineTets, splits_both_diagonals_of_a_flat_tetrahedron) {
  Labelled model = labelled(*thin_layers(), 60);
  split_level_chords(model.tets, model.levels);
  std::vector<Vec3> plan = model.tets.points;
  for (Vec3& p : plan) p.z = 0;
  const Result<StratigraphicTets> layers = find_stratigraphic_function(model.tets, model.levels);
  ASSERT_TRUE(layers);
  const std::vector<std::uint32_t> flipped = flipped_in_layers(*layers, plan);
  ASSERT_FALSE(flipped.empty());
  EXPECT_GT(split_flat_diagonals(model.tets, model.levels, plan, *layers, flipped), 0u);
  EXPECT_EQ(plan.size(), model.tets.points.size());
  EXPECT_NEAR(volume_m3(model.tets) / (1000.0 * 1000 * 300), 1, 1e-12);
}

}  // namespace
}  // namespace strataflow
