#include "kernels/hexes/extrusion/plumb_line.h"

#include <gtest/gtest.h>

#include "kernels/hexes/tet_models.h"

namespace strataflow {
namespace {

TEST(PlumbLine, finds_levels_inside_and_at_ends) {
  const PlumbLine line({{0, 10, 0, 1, 0}, {10, 40, 1, 4, 1}});
  EXPECT_DOUBLE_EQ(line.at_level(0).z, 0);
  EXPECT_DOUBLE_EQ(line.at_level(1).z, 10);
  EXPECT_DOUBLE_EQ(line.at_level(3).z, 30);
  EXPECT_DOUBLE_EQ(line.at_level(4).z, 40);
  EXPECT_FALSE(line.at_level(3).is_in_jump);
  EXPECT_EQ(line.tet_at(5), 0u);
  EXPECT_EQ(line.tet_at(35), 1u);
  EXPECT_EQ(line.tet_at(100), 1u);
}

TEST(PlumbLine, puts_levels_that_it_leaps_over_where_it_does) {
  const PlumbLine line({{0, 10, 0, 1, 0}, {10, 20, 3, 4, 1}});
  EXPECT_DOUBLE_EQ(line.at_level(2).z, 10);
  EXPECT_TRUE(line.at_level(2).is_in_jump);
  EXPECT_FALSE(line.at_level(1).is_in_jump);
  EXPECT_DOUBLE_EQ(line.at_level(3).z, 10);
}

TEST(PlumbLine, takes_the_crossing_further_from_a_reverse_fault_where_a_level_comes_twice) {
  const PlumbLine line({{0, 50, 0, 5, 0}, {50, 100, 3, 8, 1}});  // levels 3, 4 and 5 twice
  EXPECT_DOUBLE_EQ(line.at_level(3).z, 30);
  EXPECT_DOUBLE_EQ(line.at_level(5).z, 70);
  EXPECT_LE(line.at_level(4).z, line.at_level(5).z);
  EXPECT_DOUBLE_EQ(line.at_level(8).z, 100);
}

TEST(PlumbLine, knows_its_leaps_over_faults_that_need_not_be_followed) {
  EXPECT_TRUE(PlumbLine({{0, 10, 0, 1, 0}, {10, 20, 3, 4, 1}}).dropped_leaps().empty());
  const std::vector<PlumbLeap> leaps = PlumbLine({{0, 10, 0, 1, 0, false, true}, {10, 20, 3, 4, 1}}).dropped_leaps();
  ASSERT_EQ(leaps.size(), 1u);
  EXPECT_EQ(leaps[0].from_w, 1);
  EXPECT_EQ(leaps[0].to_w, 3);
}

TEST(PlumbLines, leap_where_they_cross_a_fault_that_leans_and_is_not_followed) {
  const VolumeMesh mesh = support::filled(*listric_fault(), 120);
  for (const bool is_dropped : {false, true}) {
    Result<UprightModel> model =
        take_model(mesh, is_dropped ? std::vector<std::string>{"F1"} : std::vector<std::string>{});
    ASSERT_TRUE(model) << describe(model.failure());
    const Result<LayeredSpace> space = build_layered_space(*std::move(model), {2, {}, {}});
    ASSERT_TRUE(space) << describe(space.failure());
    const PlumbLines lines(*space, space->model.points);
    EXPECT_EQ(lines.at(811, 431).dropped_leaps().size(), is_dropped ? 1u : 0u);
    EXPECT_TRUE(lines.at(311, 431).dropped_leaps().empty());
  }
}

TEST(PlumbLines, cross_the_horizons_of_a_model_where_they_are) {
  const auto columns = thin_layers();
  const LayeredSpace space = support::upright(support::filled(*columns, 120), {1, {}, {}});
  const PlumbLines lines(space, space.plan);
  EXPECT_TRUE(lines.at(-10, 500).is_empty());
  const PlumbLine line = lines.at(130.5, 271.25);
  ASSERT_FALSE(line.is_empty());
  double before = -1;
  for (std::uint32_t k = 0; k <= space.layers.layer_count(); ++k) {
    EXPECT_GT(line.at_level(k).z, before);
    before = line.at_level(k).z;
  }
  EXPECT_NEAR(line.at_level(0).z, 0, 1e-9);
  EXPECT_NEAR(before, 300, 1e-9);
}

}  // namespace
}  // namespace strataflow
