#include "kernels/quads/quantization/cut_chart.h"

#include <gtest/gtest.h>

#include "kernels/quads/quantization/round_map.h"
#include "map_shapes.h"

namespace strataflow {
namespace {

using support::MapShape;

CutChart cut(const MapShape& shape) {
  const auto flat = round_map(shape.mesh, shape.map);
  EXPECT_TRUE(flat) << describe(flat.failure());
  return cut_chart(*flat);
}

TEST(CutChart, a_plane_map_is_not_cut_and_each_value_is_one_variable) {
  MapShape shape = support::rectangle_map(3, 2, 3, 2);
  support::finish_shape(shape);
  const CutChart chart = cut(shape);
  EXPECT_TRUE(chart.branch_edges.empty());
  for (std::size_t c = 0; c < chart.corners.size(); ++c) {
    ASSERT_EQ(chart.corners[c].size(), 1u);
    EXPECT_EQ(chart.corners[c][0].variable, shape.mesh.triangles[c / 3][c % 3]);
  }
}

TEST(CutChart, a_cylinder_needs_one_branch_and_its_translation_is_the_way_around) {
  MapShape shape = support::cylinder_map(5.5, 2, 5, 3);
  support::finish_shape(shape);
  const auto flat = round_map(shape.mesh, shape.map);
  ASSERT_TRUE(flat);
  const CutChart chart = cut_chart(*flat);
  ASSERT_EQ(chart.branch_edges.size(), 1u);
  const auto points = static_cast<std::uint32_t>(chart.first_corner.size());
  std::complex<double> around = 0;
  const auto terms = chart.expand(*flat, {{points, {1, 0}}});
  EXPECT_EQ(terms.size() % 2, 0u) << "differences";
  for (const IntegerTerm& term : terms) around += static_cast<double>(term.coefficient.re) * shape.map.at(term.corner);
  EXPECT_NEAR(std::abs(around), 5.5, 1e-12);
}

TEST(CutChart, a_box_is_cut_through_its_eight_corners_and_differences_expand_exactly_in_random_charts) {
  MapShape shape = support::box_map(2.2, 3.1, 1.7, 5);
  support::insert_points(shape, 30, 2);
  support::rechart(shape, 77);
  const auto flat = round_map(shape.mesh, shape.map);
  ASSERT_TRUE(flat);
  const CutChart chart = cut_chart(*flat);
  EXPECT_GE(chart.branch_edges.size(), 7u) << "a tree through eight points";
  for (std::uint32_t h = 0; h < chart.corners.size(); ++h) {
    std::complex<double> value = 0;
    for (const IntegerTerm& term :
         chart.expand(*flat, combine(chart.corners[FlatMesh::next(h)], 0, chart.corners[h], 2)))
      value +=
          std::complex<double>(static_cast<double>(term.coefficient.re), static_cast<double>(term.coefficient.im)) *
          shape.map.at(term.corner);
    const auto own = turned(shape.map.at(FlatMesh::next(h)) - shape.map.at(h), chart.turns[h / 3]);
    EXPECT_NEAR(std::abs(value - own), 0, 1e-12) << "half-edge " << h;
  }
}

}  // namespace
}  // namespace strataflow
