#include "kernels/hexes/extrusion/fault_surface.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

/// A square fault across x = 0 of two triangles, and a horizon that is none.
LabelledTets square_fault() {
  LabelledTets model;
  model.points = {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}, {5, 0, 0}};
  SheetFacet facet;
  facet.kind = SheetKind::fault;
  for (const Triangle& t : {Triangle{0, 1, 2}, Triangle{0, 2, 3}}) {
    facet.vertices = t;
    model.facets.push_back(facet);
  }
  facet.kind = SheetKind::horizon;
  facet.vertices = {0, 1, 4};
  model.facets.push_back(facet);
  return model;
}

TEST(FaultSurface, is_met_where_its_points_are_said_to_be) {
  const LabelledTets model = square_fault();
  std::vector<Vec3> moved = model.points;
  for (Vec3& p : moved) p.x += 3;
  const FaultSurface fault(model, 0, moved);
  EXPECT_FALSE(fault.meets({-1, 0.7, 0.2}, {1, 0.7, 0.2}));
  EXPECT_TRUE(fault.meets({2, 0.7, 0.2}, {4, 0.7, 0.2}));
}

TEST(FaultSurface, is_met_by_rays_through_triangles_and_through_the_edge_between_them) {
  const LabelledTets model = square_fault();
  const FaultSurface fault(model, 0);
  EXPECT_TRUE(fault.meets({-1, 0.7, 0.2}, {1, 0.7, 0.2}));
  EXPECT_TRUE(fault.meets({-1, 0.5, 0.5}, {1, 0.5, 0.5}));
  EXPECT_TRUE(fault.meets({0, 0.7, 0.2}, {1, 0.7, 0.2}));
}

TEST(FaultSurface, is_missed_beside_before_and_behind_it) {
  const LabelledTets model = square_fault();
  const FaultSurface fault(model, 0);
  EXPECT_FALSE(fault.meets({-1, 1.2, 0.2}, {1, 1.2, 0.2}));
  EXPECT_FALSE(fault.meets({-1, 0.7, 0.2}, {-0.1, 0.7, 0.2}));
  EXPECT_FALSE(fault.meets({2, 0.2, -1}, {2, 0.2, 1}));  // through the horizon
  EXPECT_FALSE(FaultSurface(model, 3).meets({-1, 0.7, 0.2}, {1, 0.7, 0.2}));
}

}  // namespace
}  // namespace strataflow
