#include "kernels/quads/quantization/imprint_quantization.h"

#include <gtest/gtest.h>

#include "map_shapes.h"
#include "quantized_checks.h"

namespace strataflow {
namespace {

using support::MapShape;

std::vector<std::uint32_t> integer_points(const Quantization& q) {
  std::vector<std::uint32_t> points;
  for (std::uint32_t p = 0; p < q.decimated.kind.size(); ++p)
    if (q.decimated.kind[p] == PointKind::integer) points.push_back(p);
  return points;
}

double imprinted_area(const MapShape& shape, const QuantizeOptions& options = {}) {
  const auto q = quantize_map(shape.mesh, shape.map, options);
  EXPECT_TRUE(q) << (q ? "" : describe(q.failure()));
  if (!q) return -1;
  const auto imprinted = imprint_quantization(shape.mesh, shape.map, *q);
  EXPECT_TRUE(imprinted) << (imprinted ? "" : describe(imprinted.failure()));
  if (!imprinted) return -1;
  return support::expect_grid_preserving(imprinted->mesh, imprinted->map, integer_points(*q), q->unmet_features);
}

TEST(ImprintQuantization, a_rectangle_with_inner_features_becomes_a_grid_of_whole_numbers) {
  MapShape shape = support::rectangle_map(8.3, 6.4, 8, 6);
  support::add_feature(shape, {20, 21, 22, 23, 24}, "tip inside");
  support::add_feature(shape, {45, 46, 47, 48, 49}, "from the west side");
  support::finish_shape(shape);
  EXPECT_DOUBLE_EQ(imprinted_area(shape), 48);
  support::rechart(shape, 4);
  EXPECT_DOUBLE_EQ(imprinted_area(shape), 48);
}

TEST(ImprintQuantization, boxes_with_random_points_and_charts_come_out_exact) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    MapShape shape = support::box_map(3.73, 5.51, 1.82, seed);
    support::insert_points(shape, 60, seed);
    EXPECT_NEAR(imprinted_area(shape), 88, 1e-9) << seed;
    EXPECT_NEAR(imprinted_area(shape, {.coarse = true}), 6, 1e-9) << seed;
  }
}

TEST(ImprintQuantization, paths_may_pass_points_at_any_distance_or_right_through_them) {
  // The diagonal of the decimated square runs through the inner points of a grid, but for 1e-14 … 1e-4.
  for (int exponent = -14; exponent <= -4; ++exponent)
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      MapShape shape = support::rectangle_map(6.2, 6.2, 6, 6);
      RandomStream random(seed);
      const double size = std::pow(10.0, exponent);
      for (int j = 1; j < 6; ++j)
        for (int i = 1; i < 6; ++i)
          support::move_point(shape, static_cast<std::uint32_t>(7 * j + i), 6.2 * i / 6 + size * (random.unit() - 0.5),
                              6.2 * j / 6 + size * (random.unit() - 0.5));
      support::finish_shape(shape);
      EXPECT_NEAR(imprinted_area(shape), 36, 1e-9) << size << " seed " << seed;
    }
}

// T27: with a free boundary only what lies inside is bound to integers.
TEST(ImprintQuantization, a_free_boundary_crosses_the_grid_at_any_angle_and_an_aligned_one_follows_it) {
  MapShape shape = support::rectangle_map(8.3, 6.4, 8, 6, true);
  const std::complex<double> turn = std::polar(1.0, 0.5);
  for (std::size_t c = 0; c < shape.map.uv.size(); ++c) {
    const auto z = turn * shape.map.at(static_cast<std::uint32_t>(c));
    shape.map.uv[c] = {z.real(), z.imag()};
  }
  support::finish_shape(shape);
  const auto q = quantize_map(shape.mesh, shape.map, {.keep_shape = true});
  ASSERT_TRUE(q);
  EXPECT_EQ(q->offsets, 4u) << "the four bends of the boundary are no vertices of quads";
  const auto free = imprint_quantization(shape.mesh, shape.map, *q);
  ASSERT_TRUE(free) << describe(free.failure());
  support::expect_grid_preserving(free->mesh, free->map, integer_points(*q));
  const auto opposite = support::opposites(free->mesh);
  int off_axis = 0, boundary = 0;
  for (std::uint32_t h = 0; h < opposite.size(); ++h) {
    if (opposite[h] != FlatMesh::outside) continue;
    const auto along = free->map.at(FlatMesh::next(h)) - free->map.at(h);
    off_axis += along.real() != 0 && along.imag() != 0;
    ++boundary;
  }
  EXPECT_EQ(boundary, 28);
  EXPECT_GE(off_axis, 20);
}

TEST(ImprintQuantization, columns_of_many_heights_come_out_exact) {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    MapShape shape = support::terrain_map(3, seed);
    support::insert_points(shape, 80, seed);
    imprinted_area(shape);
  }
}

TEST(ImprintQuantization, straightened_curves_are_refused) {
  MapShape shape = support::rectangle_map(6, 4, 6, 4, true);
  support::move_point(shape, 3, 3, -0.2);
  shape.mesh.corners = {0, 6, 28, 34};
  support::finish_shape(shape);
  const auto loose = quantize_map(shape.mesh, shape.map);
  ASSERT_TRUE(loose);
  const auto refused = imprint_quantization(shape.mesh, shape.map, *loose);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.failure().what.find("straightened"), std::string::npos);
  EXPECT_GT(imprinted_area(shape, {.keep_shape = true}), 0);
}

TEST(ImprintQuantization, gives_the_same_bits_again) {
  MapShape shape = support::terrain_map(2, 6);
  support::insert_points(shape, 50, 1);
  const auto q = quantize_map(shape.mesh, shape.map);
  ASSERT_TRUE(q);
  const auto a = imprint_quantization(shape.mesh, shape.map, *q), b = imprint_quantization(shape.mesh, shape.map, *q);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(a->map.uv, b->map.uv);
  EXPECT_EQ(a->mesh.triangles, b->mesh.triangles);
}

TEST(ImprintQuantization, paths_over_the_torus_wind_around_it) {
  MapShape shape = support::torus_map(5.3, 3.6, 7, 5);
  EXPECT_NEAR(imprinted_area(shape), 20, 1e-9);
}

}  // namespace
}  // namespace strataflow
