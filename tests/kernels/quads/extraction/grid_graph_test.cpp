#include "kernels/quads/extraction/grid_graph.h"

#include <gtest/gtest.h>

#include "base/id.h"
#include "kernels/quads/extraction/extract_quads.h"
#include "kernels/quads/extraction/grid_map.h"
#include "kernels/quads/extraction/map_samples.h"
#include "kernels/quads/extraction/smooth_quads.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

using namespace map_samples;

TEST(GridMap, is_exact_where_the_map_was_nearly_so) {
  MappedMesh m = rectangle(4, 3, {line("a", Role::fault, {{1, 1, 0}, {3, 1, 0}})});
  rechart(m, 9, 1e-5);
  const auto exact = exact_grid_map(m.mesh, m.map);
  ASSERT_TRUE(exact) << describe(exact.failure());
  for (std::uint32_t h = 0; h < exact->opposite.size(); ++h) {
    const std::uint32_t g = exact->opposite[h];
    if (g == no_index) continue;
    EXPECT_EQ(exact->into(h, exact->uv[GridMap::next(g)]), exact->uv[h]);
    EXPECT_EQ(exact->into(h, exact->uv[g]), exact->uv[GridMap::next(h)]);
    EXPECT_EQ(exact->shift[h].re % GridMap::unit, 0);
  }
  for (const std::uint32_t c : m.mesh.corners) {
    EXPECT_EQ(exact->uv[exact->first_out[c]].re % GridMap::unit, 0);
    EXPECT_EQ(exact->uv[exact->first_out[c]].im % GridMap::unit, 0);
  }
}

TEST(GridMap, refuses_a_jump_that_is_no_whole_number) {
  MappedMesh m = rectangle(4, 3, {});
  for (std::size_t k = 0; k < 3; ++k) m.map.uv[3 * 5 + k][0] += 0.3;
  const auto refused = exact_grid_map(m.mesh, m.map);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.failure().what.find("no whole number"), std::string::npos) << refused.failure().what;
}

TEST(GridGraph, steps_come_in_pairs_and_only_the_boundary_lets_them_out) {
  MappedMesh m = rectangle(3, 2, {});
  rechart(m, 4);
  const auto exact = exact_grid_map(m.mesh, m.map);
  ASSERT_TRUE(exact);
  const auto graph = trace_grid(m.mesh, *exact);
  ASSERT_TRUE(graph) << describe(graph.failure());
  EXPECT_EQ(graph->vertices.size(), 12u);
  EXPECT_EQ(graph->ports.size(), 2u * 17);
  for (std::uint32_t p = 0; p < graph->ports.size(); ++p) {
    ASSERT_NE(graph->partner[p], no_index);
    EXPECT_EQ(graph->partner[graph->partner[p]], p);
    const Vec3 step =
        graph->positions[graph->ports[graph->partner[p]].vertex] - graph->positions[graph->ports[p].vertex];
    EXPECT_NEAR(length(step), 1, 1e-8);
  }
  EXPECT_EQ(std::count(graph->is_on_boundary.begin(), graph->is_on_boundary.end(), 1), 10);
  EXPECT_FALSE(trace_grid(m.mesh, *exact, 5));
}

TEST(ExtractAndSmooth, give_the_same_bits_on_every_schedule) {
  MappedMesh m = rectangle(9, 7, {line("a", Role::fault, {{2, 3, 0}, {7, 3, 0}})});
  rechart(m, 6);
  QuadMesh reference;
  support::on_every_schedule([&](const char* schedule) {
    QuadMesh quads = *extract_quads(m.mesh, m.map);
    for (std::size_t p = 0; p < quads.points.size(); p += 3)
      if (quads.points[p].y > 3.5 && quads.points[p].y < 6.5 && quads.points[p].x > 0.5 && quads.points[p].x < 8.5)
        quads.points[p].x += 0.4;
    ASSERT_TRUE(smooth_quads(quads, m.mesh));
    if (reference.points.empty()) reference = quads;
    EXPECT_EQ(quads.points, reference.points) << schedule;
    EXPECT_EQ(quads.quads, reference.quads) << schedule;
  });
}

}  // namespace
}  // namespace strataflow
