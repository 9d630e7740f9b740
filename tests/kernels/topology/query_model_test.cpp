#include "kernels/topology/query_model.h"

#include <gtest/gtest.h>

#include "base/seed.h"
#include "kernels/topology/building/build_structural_model.h"
#include "support/shapes.h"

namespace strataflow {
namespace {

TEST(ModelQueries, every_point_lies_in_the_layer_its_height_says) {
  const StructuralModel model = build_structural_model(support::layered_box({0, 0.25, 0.5, 1}))->model;
  const ModelQueries queries(model);
  RandomStream random(1);
  const std::uint32_t low = queries.region_at({.5, .5, .1}), middle = queries.region_at({.5, .5, .4}),
                      high = queries.region_at({.5, .5, .9});
  EXPECT_NE(low, middle);
  EXPECT_NE(middle, high);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p{1.4 * random.unit() - .2, 1.4 * random.unit() - .2, 1.4 * random.unit() - .2};
    const bool inside = p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1 && p.z > 0 && p.z < 1;
    const std::uint32_t expected = !inside ? universe : p.z < .25 ? low : p.z < .5 ? middle : high;
    EXPECT_EQ(queries.region_at(p), expected);
  }
}

TEST(ModelQueries, points_above_edges_and_vertices_are_decided_like_any_other) {
  const StructuralModel model = build_structural_model(support::nested_boxes())->model;
  const ModelQueries queries(model);
  const std::uint32_t outer = queries.region_at({.5, .5, .5}), inner = queries.region_at({1.5, 1.4, 1.5});
  EXPECT_EQ(queries.region_at({1, 1, 0.5}), outer);  // below an edge of the inner box
  EXPECT_EQ(queries.region_at({2, 2, 0.5}), outer);
  EXPECT_EQ(queries.region_at({1.5, 1.5, 1.5}), inner);  // below the diagonals of both tops
  EXPECT_EQ(queries.region_at({0, 0, -1}), universe);
}

TEST(ModelQueries, a_well_passes_the_layers_in_order) {
  const StructuralModel model = build_structural_model(support::layered_box({0, 0.25, 0.5, 1}))->model;
  const ModelQueries queries(model);
  const std::vector<Vec3> well{{.4, .3, 2}, {.4, .3, .75}, {.4, .3, -1}};
  const auto stretches = queries.regions_along(well);
  ASSERT_EQ(stretches.size(), 5u);
  EXPECT_EQ(stretches.front().region, universe);
  EXPECT_EQ(stretches.back().region, universe);
  EXPECT_NEAR(stretches[1].begin_m, 1.0, 1e-12);
  EXPECT_NEAR(stretches[1].end_m, 1.5, 1e-12);
  EXPECT_NEAR(stretches[2].end_m, 1.75, 1e-12);
  EXPECT_NEAR(stretches[3].end_m, 2.0, 1e-12);
  EXPECT_EQ(queries.crossings_along(well).size(), 4u);
}

TEST(ModelQueries, adjacency_is_complete_for_two_layers) {
  const StructuralModel model = build_structural_model(support::layered_box({0, 0.5, 1}))->model;
  const ModelQueries queries(model);
  EXPECT_EQ(queries.surfaces_of_line(0), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_EQ(queries.neighbours_of_region(0), std::vector<std::uint32_t>{1});
  EXPECT_EQ(queries.surfaces_of_region(0).size(), 2u);
  EXPECT_TRUE(model.corners.empty());
}

TEST(ModelQueries, a_path_through_edges_and_vertices_crosses_each_surface_once) {
  // A sheet of triangles of many slopes around each edge, so that places computed from their planes would differ.
  TriangleSoup soup;
  const std::uint32_t patch = support::add_patch(soup, "H");
  RandomStream random(5);
  constexpr int side = 12;
  std::vector<Vec3> grid;
  for (int j = 0; j <= side; ++j)
    for (int i = 0; i <= side; ++i) grid.push_back({i / 3.0, j / 7.0, random.unit() / 3});
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const int k = j * (side + 1) + i;
      support::add_quad(soup, patch, grid[k], grid[k + 1], grid[k + side + 2], grid[k + side + 1]);
    }
  const StructuralModel model = build_structural_model(soup)->model;
  const ModelQueries queries(model);
  for (int k = 0; k + side + 1 < static_cast<int>(grid.size()); ++k) {
    const Vec3& v = grid[k];
    const auto through_vertex = queries.crossings_along({{v.x, v.y, 2.1}, {v.x, v.y, -1.3}});
    ASSERT_EQ(through_vertex.size(), 1u) << k;
    EXPECT_NEAR(through_vertex[0].point.z, v.z, 1e-14);
    const Vec3& w = grid[k + side + 1];
    const double y = v.y + 0.3 * (w.y - v.y);  // x is that of both: exactly on the edge seen from above
    EXPECT_EQ(queries.crossings_along({{v.x, y, 2.1}, {v.x, y, -1.3}}).size(), 1u) << k;
    EXPECT_EQ(queries.crossings_along({{v.x, y, 2.1}, v, {v.x + .01, v.y, -1.3}}).size(), 1u)
        << k;  // ends a segment on it
  }
}

}  // namespace
}  // namespace strataflow
