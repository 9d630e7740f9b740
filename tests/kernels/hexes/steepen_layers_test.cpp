#include "kernels/hexes/steepen_layers.h"

#include <gtest/gtest.h>

#include "kernels/hexes/tet_models.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

using support::LevelledTets;

const LevelledTets& model() {
  static const LevelledTets levelled = support::levelled(support::filled(*vertical_faults(2, false), 150));
  return levelled;
}

/// W with every fifth copy between levels pushed close to the roof of its unit.
StratigraphicTets spoilt() {
  StratigraphicTets layers = *find_stratigraphic_function(model().tets, model().levels);
  std::vector<char> is_seen(layers.w.size(), 0);
  std::size_t free = 0;
  for (std::uint32_t t = 0; t < layers.model_tets; ++t)
    for (const std::uint32_t copy : layers.tets[t]) {
      const double roof = layers.level_w[model().levels.unit[t] + 1], floor = layers.level_w[model().levels.unit[t]];
      if (is_seen[copy]++ || layers.w[copy] == roof || layers.w[copy] == floor) continue;
      if (free++ % 5 == 0) layers.w[copy] = roof - 0.01 * (roof - floor);
    }
  return layers;
}

TEST(SteepenLayers, make_w_rise_everywhere_and_leave_horizons_alone) {
  const StratigraphicTets before = spoilt();
  ASSERT_GT(flipped_in_layers(before, model().tets.points).size(), 10u);
  StratigraphicTets layers = before;
  const auto solves = steepen_layers(model().tets, model().levels, model().tets.points, layers);
  ASSERT_TRUE(solves) << describe(solves.failure());
  EXPECT_GT(*solves, 0u);
  EXPECT_TRUE(flipped_in_layers(layers, model().tets.points).empty());
  for (std::size_t c = 0; c < layers.w.size(); ++c)
    if (before.w[c] == std::round(before.w[c])) EXPECT_EQ(layers.w[c], before.w[c]);
}

TEST(SteepenLayers, leave_what_rises_as_it_is) {
  const StratigraphicTets before = *find_stratigraphic_function(model().tets, model().levels);
  ASSERT_TRUE(flipped_in_layers(before, model().tets.points).empty());
  StratigraphicTets layers = before;
  EXPECT_EQ(*steepen_layers(model().tets, model().levels, model().tets.points, layers), 0u);
  EXPECT_EQ(layers.w, before.w);
}

TEST(SteepenLayers, keep_the_best_when_nothing_can_help) {
  // Seen in a mirror all falls: W must come back as it was, after a bounded number of solves.
  std::vector<Vec3> mirror = model().tets.points;
  for (Vec3& p : mirror) p.x = -p.x;
  const StratigraphicTets before = *find_stratigraphic_function(model().tets, model().levels);
  StratigraphicTets layers = before;
  const auto solves = steepen_layers(model().tets, model().levels, mirror, layers, 14);
  ASSERT_TRUE(solves) << describe(solves.failure());
  EXPECT_LE(*solves, 14u);
  for (const double w : layers.w) EXPECT_TRUE(std::isfinite(w));
}

TEST(SteepenLayers, have_the_same_bits_on_every_schedule) {
  StratigraphicTets expected = spoilt();
  ASSERT_TRUE(steepen_layers(model().tets, model().levels, model().tets.points, expected));
  support::on_every_schedule([&](const char* schedule) {
    StratigraphicTets layers = spoilt();
    ASSERT_TRUE(steepen_layers(model().tets, model().levels, model().tets.points, layers));
    EXPECT_EQ(layers.w, expected.w) << schedule;
  });
}

}  // namespace
}  // namespace strataflow
