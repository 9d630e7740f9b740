#include "kernels/quads/quantization/decimate_map.h"

#include <gtest/gtest.h>

#include <set>

#include "kernels/quads/quantization/round_map.h"
#include "map_shapes.h"

namespace strataflow {
namespace {

using support::MapShape;
constexpr std::uint32_t outside = FlatMesh::outside;

struct Decimated {
  FlatMesh flat;
  CutChart cut;
  DecimatedMap map;
};

Decimated decimate(const MapShape& shape, const DecimateOptions& options = {}) {
  auto flat = round_map(shape.mesh, shape.map);
  EXPECT_TRUE(flat) << (flat ? "" : describe(flat.failure()));
  Decimated d{*flat, cut_chart(*flat), {}};
  d.map = decimate_map(shape.mesh, d.flat, d.cut, options);
  return d;
}

std::vector<std::uint32_t> points_of(const FlatMesh& mesh) {
  std::set<std::uint32_t> points(mesh.origin.begin(), mesh.origin.end());
  return {points.begin(), points.end()};
}

/// Rules R14: closed, seamed, positive, axes and cone angles kept; D·U is the vector itself.
void expect_sound(const MapShape& shape, const Decimated& d) {
  const FlatMesh& m = d.map.mesh;
  std::vector<std::int32_t> quarters(shape.mesh.points.size(), 0);
  for (std::uint32_t h = 0; h < m.half_edge_count(); ++h) {
    quarters[m.origin[h]] += m.corner_quarters(h);
    if (h % 3 == 0) {
      ASSERT_TRUE(m.is_positive(h / 3));
      ASSERT_EQ(m.vector[h] + m.vector[h + 1] + m.vector[h + 2], GaussianInteger{});
    }
    const std::uint32_t o = m.opposite[h];
    if (o != outside) {
      ASSERT_EQ(m.opposite[o], h);
      ASSERT_EQ(m.origin[o], m.end(h));
      ASSERT_EQ(m.vector[h], -turned(m.vector[o], m.turns[h]));
      ASSERT_EQ(m.curve[h], m.curve[o]);
      ASSERT_EQ(m.axis[h], turned(m.axis[o], m.turns[h]));
    }
    std::complex<double> value = 0;
    for (const IntegerTerm& term : d.cut.expand(d.flat, d.map.forms[h]))
      value +=
          std::complex<double>(static_cast<double>(term.coefficient.re), static_cast<double>(term.coefficient.im)) *
          shape.map.at(term.corner);
    EXPECT_NEAR(value.real(), static_cast<double>(m.vector[h].re) * m.step, 1e-9) << "half-edge " << h;
    EXPECT_NEAR(value.imag(), static_cast<double>(m.vector[h].im) * m.step, 1e-9) << "half-edge " << h;
  }
  for (const std::uint32_t p : points_of(m)) EXPECT_EQ(quarters[p], d.map.quarters[p]) << "point " << p;
  const auto bearing = [&](std::uint32_t h) { return d.map.bearing[h]; };
  for (std::uint32_t h = 0; h < m.half_edge_count(); ++h) {
    const std::uint32_t left = m.left_of(h);
    if (left == outside) continue;
    int step = bearing(left) - bearing(h) - m.corner_quarters(h);
    if (m.right_of(h) != outside) step %= d.map.quarters[m.origin[h]];
    EXPECT_EQ(step, 0) << "bearings at half-edge " << h;
  }
}

TEST(DecimateMap, a_grid_of_squares_becomes_two_triangles) {
  MapShape shape = support::rectangle_map(4.3, 2.7, 6, 5);
  support::finish_shape(shape);
  const Decimated d = decimate(shape);
  expect_sound(shape, d);
  EXPECT_EQ(d.map.mesh.half_edge_count(), 6u);
  EXPECT_EQ(points_of(d.map.mesh), shape.mesh.corners);
  EXPECT_TRUE(d.map.is_embedded);
}

TEST(DecimateMap, random_charts_and_points_on_a_box_leave_its_eight_corners) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    MapShape shape = support::box_map(3.7, 5.5, 1.8, seed);
    support::insert_points(shape, 60, seed);
    support::rechart(shape, seed + 100);
    const Decimated d = decimate(shape);
    expect_sound(shape, d);
    EXPECT_EQ(d.map.mesh.half_edge_count(), 36u);
    EXPECT_EQ(points_of(d.map.mesh), (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  }
}

TEST(DecimateMap, a_point_in_the_middle_of_a_cross_goes_too) {
  // Four triangles around the middle of a square: no flip there leaves two positive triangles.
  MapShape shape;
  shape.mesh.points = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 0}};
  shape.mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
  shape.mesh.corners = {0, 1, 2, 3};
  for (const Triangle& t : shape.mesh.triangles)
    for (const std::uint32_t p : t) shape.map.uv.push_back({shape.mesh.points[p].x, shape.mesh.points[p].y});
  support::finish_shape(shape);
  const Decimated d = decimate(shape);
  expect_sound(shape, d);
  EXPECT_EQ(points_of(d.map.mesh), shape.mesh.corners);
}

TEST(DecimateMap, a_torus_keeps_one_point_that_nothing_binds) {
  MapShape shape = support::torus_map(5.3, 3.6, 7, 5);
  support::rechart(shape, 3, false);
  const Decimated d = decimate(shape);
  expect_sound(shape, d);
  ASSERT_EQ(points_of(d.map.mesh).size(), 1u);
  EXPECT_EQ(d.map.mesh.half_edge_count(), 6u);
  EXPECT_EQ(d.map.kind[points_of(d.map.mesh)[0]], PointKind::free);
}

TEST(DecimateMap, tips_and_junctions_of_features_stay_and_their_chains_become_single_edges) {
  MapShape shape = support::rectangle_map(8, 6, 8, 6);
  support::add_feature(shape, {20, 21, 22, 23, 24}, "tip inside");          // row 2, columns 2…6
  support::add_feature(shape, {45, 46, 47, 48, 49}, "from the west side");  // row 5, columns 0…4
  support::finish_shape(shape);
  support::rechart(shape, 11);
  const Decimated d = decimate(shape);
  expect_sound(shape, d);
  EXPECT_EQ(points_of(d.map.mesh), shape.mesh.corners);
  int chains = 0;
  for (std::uint32_t h = 0; h < d.map.mesh.half_edge_count(); ++h)
    chains += d.map.mesh.curve[h] != 0 && d.map.mesh.curve_features[d.map.mesh.curve[h]][0] >= 4;
  EXPECT_EQ(chains, 4) << "two inner edges seen from both sides";
}

TEST(DecimateMap, a_closed_feature_keeps_one_point_and_a_free_wavy_boundary_is_straightened_only_if_allowed) {
  MapShape shape = support::rectangle_map(6, 4, 6, 4, true);
  shape.mesh.points[3].y -= 0.2;
  shape.mesh.corners = {0, 6, 28, 34};
  for (std::size_t c = 0; c < shape.map.uv.size(); ++c)
    if (shape.mesh.triangles[c / 3][c % 3] == 3) shape.map.uv[c][1] -= 0.2;
  support::finish_shape(shape);
  const Decimated loose = decimate(shape), strict = decimate(shape, {.keep_shape = true});
  expect_sound(shape, loose);
  expect_sound(shape, strict);
  EXPECT_EQ(points_of(loose.map.mesh), (std::vector<std::uint32_t>{0, 6, 28, 34}));
  EXPECT_FALSE(loose.map.is_embedded);
  EXPECT_EQ(points_of(strict.map.mesh), (std::vector<std::uint32_t>{0, 2, 3, 4, 6, 28, 34}));
  EXPECT_EQ(strict.map.kind[3], PointKind::free);
  EXPECT_TRUE(strict.map.is_embedded);
}

// T29, the growth: flips with the triangles of the map, log-log; 1.1 is what we see.
TEST(DecimateMap, flips_grow_with_the_triangles) {
  const auto flips = [](int points) {
    MapShape shape = support::terrain_map(4, 3);
    support::insert_points(shape, points, 7);
    const auto flat = round_map(shape.mesh, shape.map);
    return static_cast<double>(decimate_map(shape.mesh, *flat, cut_chart(*flat)).flips);
  };
  EXPECT_LT(std::log(flips(8000) / flips(500)) / std::log(16), 1.3);
}

TEST(DecimateMap, gives_the_same_bits_again) {
  MapShape shape = support::box_map(3.7, 5.5, 1.8, 4);
  support::insert_points(shape, 100, 5);
  const Decimated a = decimate(shape), b = decimate(shape);
  EXPECT_EQ(a.map.mesh.vector, b.map.mesh.vector);
  EXPECT_EQ(a.map.mesh.origin, b.map.mesh.origin);
  EXPECT_EQ(a.map.flips, b.map.flips);
}

}  // namespace
}  // namespace strataflow
