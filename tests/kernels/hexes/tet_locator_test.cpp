#include "kernels/hexes/tet_locator.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "kernels/hexes/tet_models.h"

namespace strataflow {
namespace {

class TetLocation : public testing::Test {
 protected:
  LayeredSpace space_ = support::upright(support::filled(*vertical_faults(0, false), 150), {2, {}, {}});
  TetLocator locator_{space_, 100};
};

TEST_F(TetLocation, finds_the_tetrahedron_around_a_point_and_lifts_it_to_its_layer) {
  const Vec3 p = locator_.at({700, 555, 0}, 3.3);
  const TetLocator::Place place = locator_.locate(p, 100);
  ASSERT_NE(place.tet, no_index);
  EXPECT_LE(place.outside_m, 0);
  const Vec3 lifted = locator_.lifted(place.tet, p);
  EXPECT_NEAR(lifted.x, 700, 1e-9);
  EXPECT_NEAR(lifted.y, 555, 1e-9);
  EXPECT_GT(lifted.z, 90);  // between H1 and H2
  EXPECT_LT(lifted.z, 215);
}

TEST_F(TetLocation, is_on_the_horizon_whatever_w_does_elsewhere) {
  LayeredSpace space = space_;
  const double level = space.layers.level_w[2];
  std::size_t held_twice = 0;
  for (std::uint32_t astray = 0; astray < space.layers.model_tets && held_twice < 5; ++astray) {
    const Tet& tet = space.layers.tets[astray];
    if (std::any_of(tet.begin(), tet.end(), [&](std::uint32_t copy) { return space.layers.w[copy] == level; }))
      continue;
    Vec3 middle;
    for (std::size_t k = 0; k < 4; ++k) {  // W leaps over the level inside it
      space.layers.w[tet[k]] = k % 2 == 0 ? level - 0.5 : level + 0.5;
      middle = middle + 0.25 * space.plan[space.layers.point[tet[k]]];
    }
    const TetLocator locator(space, 100);
    const Vec3 p = locator.at(middle, level);
    if (locator.outside_m(astray, p) < -1) {
      ++held_twice;
      const TetLocator::Place place = locator.locate(p, 100);
      EXPECT_TRUE(place.is_on_level);
      std::size_t on_level = 0;
      for (const std::uint32_t copy : space.layers.tets[place.tet]) on_level += space.layers.w[copy] == level;
      EXPECT_EQ(on_level, 3u);
    }
    space.layers.w = space_.layers.w;
  }
  EXPECT_EQ(held_twice, 5u);
}

TEST_F(TetLocation, says_how_far_outside_a_point_lies) {
  const TetLocator::Place place = locator_.locate(locator_.at({-30, 555, 0}, 3.3), 100);
  ASSERT_NE(place.tet, no_index);
  EXPECT_GT(place.outside_m, 20);  // from the planes of its faces
  EXPECT_LE(place.outside_m, 30);
  EXPECT_EQ(locator_.locate(locator_.at({-300, 555, 0}, 3.3), 100).tet, no_index);
}

TEST_F(TetLocation, finds_everything_in_a_ball_and_nothing_else) {
  const Vec3 p = locator_.at({700, 555, 0}, 3.3);
  const std::vector<std::uint32_t> ball = locator_.in_ball(p, 20);
  const TetLocator::Place place = locator_.locate(p, 100);
  EXPECT_TRUE(std::binary_search(ball.begin(), ball.end(), place.tet));
  for (const std::uint32_t t : ball) EXPECT_LE(locator_.outside_m(t, p), 20);
  EXPECT_GT(locator_.in_ball(p, 60).size(), ball.size());
}

TEST_F(TetLocation, comes_back_to_the_border_at_the_same_level) {
  const Vec3 p = locator_.at({-30, 555, 0}, 3.3);
  double least = 1e9;
  for (const std::uint32_t t : locator_.in_ball(p, 60)) {
    const TetLocator::LevelPoint nearest = locator_.nearest_at_level(t, p);
    if (nearest.distance_m > 1e8) continue;
    least = std::min(least, nearest.distance_m);
    EXPECT_EQ(nearest.at.z, p.z);
  }
  EXPECT_NEAR(least, 30, 1e-9);
}

TEST_F(TetLocation, by_heights_lifts_a_point_to_its_height) {
  const TetLocator heights = TetLocator::of_heights(space_);
  const Vec3 p = heights.at({700, 555, 0}, 123);
  const TetLocator::Place place = heights.locate(p, 100);
  ASSERT_NE(place.tet, no_index);
  EXPECT_LT(place.tet, space_.layers.model_tets);
  EXPECT_LT(length(heights.lifted(place.tet, p) - Vec3{700, 555, 123}), 1e-9);
}

}  // namespace
}  // namespace strataflow
