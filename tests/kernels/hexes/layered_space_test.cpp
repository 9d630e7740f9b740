#include "kernels/hexes/layered_space.h"

#include <gtest/gtest.h>

#include "kernels/hexes/tet_models.h"

namespace strataflow {
namespace {

/// R9: nothing that extrusion would have to leave aside.
void expect_positive(const LayeredSpace& space) {
  EXPECT_EQ(space.flipped.size(), 0u);
  EXPECT_TRUE(flipped_in_layers(space.layers, space.plan).empty());
  EXPECT_EQ(space.plan.size(), space.model.points.size());
  EXPECT_EQ(space.levels.unit.size(), space.model.tets.size());
}

TEST(LayeredSpace, is_positive_with_vertical_faults) {
  for (const std::uint32_t faults : {0u, 3u, 12u})
    expect_positive(support::upright(support::filled(*vertical_faults(faults, true), 80)));
}

TEST(LayeredSpace, bends_tetrahedra_apart_that_are_flat_between_an_erosion_and_what_it_cuts) {
  const LayeredSpace space = support::upright(support::filled(*unconformity(false), 80));
  expect_positive(space);
  EXPECT_FALSE(space.changes.empty());
}

TEST(LayeredSpace, is_positive_in_layers_of_a_centimetre) {
  expect_positive(support::upright(support::filled(*thin_layers(), 50)));
}

}  // namespace
}  // namespace strataflow
