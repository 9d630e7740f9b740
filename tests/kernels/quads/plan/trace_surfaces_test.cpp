// Fault surfaces as lines of a map.
#include "kernels/quads/plan/trace_surfaces.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace strataflow {
namespace {

/// A fault of 3 × 1 squares whose top runs along x at z = 10, falling `dip_y` to the north over 10 m of depth, given as
/// patches that share no points.
TriangleSoup fault(double dip_y) {
  TriangleSoup soup;
  soup.entities = {{"F1", Role::fault}};
  for (std::uint32_t i = 0; i < 3; ++i) {
    const auto first = static_cast<std::uint32_t>(soup.points.size());
    const double x = 10.0 * i;
    soup.points.insert(soup.points.end(), {{x, 0, 10}, {x + 10, 0, 10}, {x + 10, dip_y, 0}, {x, dip_y, 0}});
    soup.triangles.push_back({first, first + 1, first + 2});
    soup.triangles.push_back({first, first + 2, first + 3});
    soup.patch_entity.push_back(0);
    soup.triangle_patch.insert(soup.triangle_patch.end(), {i, i});
  }
  return soup;
}

TEST(TraceSurfaces, the_upper_border_of_a_fault_is_its_trace) {
  for (const double dip_y : {0.0, 3.0, -20.0}) {
    const std::vector<Polyline> traces = traces_of_surfaces(fault(dip_y));
    ASSERT_EQ(traces.size(), 1u) << dip_y;
    EXPECT_EQ(traces[0].name, "F1");
    EXPECT_EQ(traces[0].role, Role::fault);
    EXPECT_FALSE(traces[0].is_closed);
    ASSERT_EQ(traces[0].points.size(), 4u);
    for (const Vec3& p : traces[0].points) EXPECT_EQ(p.z, 10);
    EXPECT_EQ(traces[0].points.front().x, 0);
    EXPECT_EQ(traces[0].points.back().x, 30);
  }
}

TEST(TraceSurfaces, a_fault_in_two_pieces_has_two_traces_and_a_level_surface_none) {
  TriangleSoup torn = fault(3);
  for (std::size_t p = 8; p < torn.points.size(); ++p) torn.points[p].x += 5;
  EXPECT_EQ(traces_of_surfaces(torn).size(), 2u);
  TriangleSoup level = fault(20);
  for (Vec3& p : level.points) p.z = 0;
  EXPECT_TRUE(traces_of_surfaces(level).empty());
}

TEST(TraceSurfaces, a_wall_around_something_is_a_closed_trace) {
  TriangleSoup wall = support::box({0, 0, 0}, {40, 40, 40});
  std::vector<Triangle> kept;
  std::vector<std::uint32_t> patches;
  for (std::size_t t = 0; t < wall.triangles.size(); ++t) {
    const Triangle& c = wall.triangles[t];
    if (wall.points[c[0]].z == wall.points[c[1]].z && wall.points[c[1]].z == wall.points[c[2]].z) continue;
    kept.push_back(c);
    patches.push_back(0);
  }
  wall.triangles = kept;
  wall.triangle_patch = patches;
  const std::vector<Polyline> traces = traces_of_surfaces(wall);
  ASSERT_EQ(traces.size(), 1u);
  EXPECT_TRUE(traces[0].is_closed);
  EXPECT_EQ(traces[0].points.size(), 4u);
}

}  // namespace
}  // namespace strataflow
