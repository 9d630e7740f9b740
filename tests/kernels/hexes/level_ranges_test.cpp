#include "kernels/hexes/level_ranges.h"

#include <gtest/gtest.h>

#include "kernels/hexes/tet_models.h"

namespace strataflow {
namespace {

TEST(LevelRanges, hold_several_levels_only_where_units_have_no_thickness) {
  for (const bool is_eroded : {false, true}) {
    const auto columns = is_eroded ? unconformity(false) : vertical_faults(3, true);
    const support::LevelledTets model = support::levelled(support::filled(*columns, 100));
    const FaultSplit split = split_along_faults(model.tets);
    const std::vector<LevelRange> ranges = level_ranges(model.tets, model.levels, split);
    std::size_t several = 0;
    for (std::size_t c = 0; c < ranges.size(); ++c) {
      const double z = model.tets.points[split.original[c]].z;
      EXPECT_EQ(z == 0, ranges[c].low == 0);
      EXPECT_TRUE(z != columns->box.high.z || ranges[c].high == model.levels.unit_count());
      several += !ranges[c].is_empty() && ranges[c].high > ranges[c].low ? 1 : 0;
    }
    EXPECT_EQ(several > 0, is_eroded);
  }
}

TEST(LevelRanges, hold_a_copy_at_the_highest_level_that_a_unit_touches) {
  const LevelRange range{2, 4};
  EXPECT_EQ(range.level_in(1), 2u);
  EXPECT_EQ(range.level_in(2), 3u);
  EXPECT_EQ(range.level_in(7), 4u);
  EXPECT_TRUE(LevelRange{}.is_empty());
}

}  // namespace
}  // namespace strataflow
