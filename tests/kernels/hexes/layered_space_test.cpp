#include "kernels/hexes/layered_space.h"

#include <gtest/gtest.h>

#include <algorithm>

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

TEST(TakeModel, forgets_faults_that_need_not_be_followed_and_displace_nothing) {
  VolumeMesh mesh = support::filled(*vertical_faults(0, false), 120);
  std::uint32_t entity = 0;
  while (mesh.entities[entity].role != Role::horizon) ++entity;
  mesh.entities[entity].role = Role::fault;  // parts one unit from itself
  const std::string name = mesh.entities[entity].name;
  const auto count = [&](const Result<UprightModel>& taken) {
    EXPECT_TRUE(taken) << describe(taken.failure());
    return std::count_if(taken->model.facets.begin(), taken->model.facets.end(),
                         [&](const SheetFacet& facet) { return facet.entity == entity; });
  };
  EXPECT_GT(count(take_model(mesh)), 0);
  const Result<UprightModel> taken = take_model(mesh, {name});
  EXPECT_EQ(count(taken), 0);
  EXPECT_EQ(taken->plan[5], (Vec3{taken->model.points[5].x, taken->model.points[5].y, 0}));
  const Result<LayeredSpace> space = build_layered_space(*taken, {2, {}, {}});
  ASSERT_TRUE(space) << describe(space.failure());
  expect_positive(*space);
}

}  // namespace
}  // namespace strataflow
