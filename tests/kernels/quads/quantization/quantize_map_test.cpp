#include "kernels/quads/quantization/quantize_map.h"

#include <gtest/gtest.h>

#include <map>

#include "map_shapes.h"

namespace strataflow {
namespace {

using support::MapShape;

std::complex<double> as_complex(GaussianInteger z) { return {static_cast<double>(z.re), static_cast<double>(z.im)}; }

Quantization quantize(const MapShape& shape, const QuantizeOptions& options = {}) {
  auto q = quantize_map(shape.mesh, shape.map, options);
  EXPECT_TRUE(q) << (q ? "" : describe(q.failure()));
  return *q;
}

/// Σ terms on the given map, offsets zero.
std::complex<double> value(const IntegerConstraint& row, const CornerMap& map) {
  std::complex<double> sum = 0;
  for (const IntegerTerm& term : row.terms)
    if (term.corner < map.uv.size()) sum += as_complex(term.coefficient) * map.at(term.corner);
  return sum;
}

TEST(QuantizeMap, a_map_that_is_integer_already_meets_its_own_constraints) {
  MapShape shape = support::box_map(4, 6, 2, 3);
  support::insert_points(shape, 25, 4);
  support::rechart(shape, 8);
  const Quantization q = quantize(shape);
  // 18 edges of the decimated box, less one for each of its 12 triangles but the first, and one pin.
  ASSERT_EQ(q.constraints.size(), 18u - 11u + 1u);
  for (std::size_t k = 0; k + 1 < q.constraints.size(); ++k)
    EXPECT_NEAR(std::abs(value(q.constraints[k], shape.map) - as_complex(q.constraints[k].value)), 0, 1e-9) << k;
  EXPECT_EQ(q.constraints.back().terms.size(), 1u) << "the pin";
  EXPECT_EQ(q.offsets, 0u);
}

TEST(QuantizeMap, in_a_plane_network_each_row_is_the_difference_of_two_points) {
  MapShape shape = support::rectangle_map(8.3, 6.4, 8, 6);
  support::add_feature(shape, {20, 21, 22, 23, 24}, "tip inside");
  support::finish_shape(shape);
  const Quantization q = quantize(shape);
  EXPECT_TRUE(q.unmet_features.empty());
  for (const IntegerConstraint& row : q.constraints) {
    std::map<std::uint32_t, GaussianInteger> per_point;  // all charts are the plane itself
    for (const IntegerTerm& term : row.terms) {
      GaussianInteger& sum = per_point[shape.mesh.triangles[term.corner / 3][term.corner % 3]];
      sum = sum + term.coefficient;
    }
    std::erase_if(per_point, [](const auto& entry) { return entry.second == GaussianInteger{}; });
    EXPECT_LE(per_point.size(), 2u);
  }
  // Values of kept points follow from the rows: every difference is whole, the corner at the south-west is at 0.
  const IntegerConstraint& pin = q.constraints.back();
  EXPECT_EQ(pin.value, GaussianInteger{});
  EXPECT_EQ(shape.mesh.triangles[pin.terms[0].corner / 3][pin.terms[0].corner % 3], 0u);
}

// T25.
TEST(QuantizeMap, periods_of_a_torus_are_rounded_and_its_last_point_stays_free) {
  MapShape shape = support::torus_map(5.3, 3.6, 7, 5);
  const Quantization q = quantize(shape);
  EXPECT_EQ(q.offsets, 1u);
  ASSERT_EQ(q.constraints.size(), 2u) << "two periods, no pin";
  std::vector<GaussianInteger> periods;
  for (const IntegerConstraint& row : q.constraints) {
    periods.push_back(row.value);
    for (const IntegerTerm& term : row.terms) EXPECT_LT(term.corner, shape.map.uv.size()) << "the offset cancels";
  }
  EXPECT_EQ(std::abs(cross(periods[0], periods[1])), 20);
}

TEST(QuantizeMap, offsets_stand_beside_the_values_of_free_points) {
  MapShape shape = support::rectangle_map(6, 4, 6, 4, true);
  support::move_point(shape, 3, 3, -0.2);
  shape.mesh.corners = {0, 6, 28, 34};
  support::finish_shape(shape);
  const Quantization q = quantize(shape, {.keep_shape = true});
  ASSERT_EQ(q.offsets, 3u);
  int with_offset = 0;
  for (const IntegerConstraint& row : q.constraints) {
    std::complex<double> sum = 0;
    for (const IntegerTerm& term : row.terms) {
      with_offset += term.corner >= shape.map.uv.size();
      ASSERT_LT(term.corner, shape.map.uv.size() + q.offsets);
      if (term.corner < shape.map.uv.size()) sum += as_complex(term.coefficient);
    }
    if (&row != &q.constraints.back()) {
      EXPECT_EQ(sum, 0.0) << "differences only";
    }
  }
  EXPECT_GE(with_offset, 3);
}

// S20.
TEST(QuantizeMap, a_strip_between_two_features_gets_the_rows_that_it_asks_for) {
  for (const std::uint32_t rows : {1u, 2u, 3u}) {
    MapShape shape = support::rectangle_map(10, 8, 10, 8);
    for (std::uint32_t i = 0; i <= 10; ++i) support::move_point(shape, 44 + i, i, 3.3);
    support::add_feature(shape, {35, 36, 37, 38, 39, 40}, "below");  // y = 3
    support::add_feature(shape, {46, 47, 48, 49, 50, 51}, "above");  // y = 3.3
    support::add_feature(shape, {35, 46}, "west end");
    support::add_feature(shape, {40, 51}, "east end");
    shape.mesh.features[4].strip_quads = rows;
    shape.mesh.features[4].strip_of = 5;
    support::finish_shape(shape);
    support::rechart(shape, rows);
    const Quantization q = quantize(shape);
    EXPECT_TRUE(q.unmet_features.empty());
    const FlatMesh& m = q.decimated.mesh;
    int across = 0;
    for (std::uint32_t h = 0; h < m.half_edge_count(); ++h) {
      const auto& features = m.curve_features[m.curve[h]];
      if (features != std::vector<std::uint32_t>{6} && features != std::vector<std::uint32_t>{7}) continue;
      const GaussianInteger v = q.integers.vectors[h];
      EXPECT_EQ(std::abs(v.re) + std::abs(v.im), static_cast<std::int64_t>(rows));
      ++across;
    }
    EXPECT_EQ(across, 4) << "both ends, seen from both sides";
  }
}

TEST(QuantizeMap, more_quads_are_wanted_around_crowded_points) {
  MapShape shape = support::rectangle_map(10, 8, 10, 8);
  for (std::uint32_t i = 0; i <= 10; ++i) support::move_point(shape, 44 + i, i, 3.3);
  support::add_feature(shape, {35, 36, 37, 38, 39, 40}, "below");  // y = 3
  support::add_feature(shape, {46, 47, 48, 49, 50, 51}, "above");  // y = 3.3
  support::add_feature(shape, {35, 46}, "west end");
  support::finish_shape(shape);
  const auto rows = [&](const std::vector<std::uint32_t>& crowded) {
    const Quantization q = quantize(shape, {.crowded = crowded});
    const FlatMesh& m = q.decimated.mesh;
    for (std::uint32_t h = 0; h < m.half_edge_count(); ++h)
      if (m.curve_features[m.curve[h]] == std::vector<std::uint32_t>{6})
        return std::abs(q.integers.vectors[h].re) + std::abs(q.integers.vectors[h].im);
    return std::int64_t{0};
  };
  EXPECT_EQ(rows({}), 1);
  EXPECT_GE(rows({35, 40, 35, 40}), 2) << "named twice";
  EXPECT_GE(rows({35, 40, 35, 40, 35, 40}), 3) << "and a third time";
  EXPECT_EQ(rows({1000}), 1) << "a number that is no point";
}

// T30: a feature that climbs while it goes once around cannot be level.
TEST(QuantizeMap, a_spiral_that_cannot_be_aligned_is_reported) {
  MapShape shape = support::cylinder_map(8, 6, 8, 6);
  std::vector<std::uint32_t> spiral;
  for (std::uint32_t i = 0; i < 8; ++i) {
    spiral.push_back(16 + i);
    for (std::size_t c = 0; c < shape.map.uv.size(); ++c)  // the row y = 2 rises to 2.9
      if (shape.mesh.triangles[c / 3][c % 3] == 16 + i) {
        const bool is_seam = i == 0 && shape.map.uv[c][0] > 4;
        if (!is_seam) shape.map.uv[c][1] += 0.12 * i;
      }
  }
  spiral.push_back(24);  // and on to the first point of the row above
  support::add_feature(shape, spiral, "spiral");
  support::finish_shape(shape);
  for (auto& axis : shape.map.axes)
    if (axis != MapAxis::none) axis = MapAxis::real;
  const Quantization q = quantize(shape);
  EXPECT_EQ(q.unmet_features, (std::vector<std::uint32_t>{2}));
}

TEST(QuantizeMap, a_closed_rim_without_corners_keeps_a_point_and_whole_numbers_around) {
  MapShape shape = support::cylinder_map(5.4, 2.6, 6, 3);
  support::finish_shape(shape);
  const Quantization q = quantize(shape);
  EXPECT_EQ(q.offsets, 0u);
  std::int64_t twice = 0;
  const auto& v = q.integers.vectors;
  for (std::size_t h = 0; h < v.size(); h += 3) twice += cross(v[h], v[h + 1]);
  EXPECT_EQ(twice / 2, 5 * 3);
}

TEST(QuantizeMap, a_closed_feature_never_gets_shorter_than_three_quads) {
  MapShape shape = support::cylinder_map(0.8, 2.6, 6, 3);
  support::finish_shape(shape);
  const Quantization q = quantize(shape);
  int rims = 0;
  for (std::uint32_t h = 0; h < q.decimated.mesh.half_edge_count(); ++h)
    if (q.decimated.mesh.curve[h] != 0) {
      EXPECT_EQ(std::abs(q.integers.vectors[h].re) + std::abs(q.integers.vectors[h].im), 3);
      ++rims;
    }
  EXPECT_EQ(rims, 2);
}

TEST(QuantizeMap, refuses_a_scale_that_is_not_positive_and_maps_that_are_not_seamless) {
  MapShape shape = support::rectangle_map(3, 2, 3, 2);
  support::finish_shape(shape);
  for (const double scale : {0.0, -1.0, std::nan("")}) {
    const auto q = quantize_map(shape.mesh, shape.map, {.quads_per_unit = scale});
    ASSERT_FALSE(q);
    EXPECT_EQ(q.failure().code, FailureCode::invalid_options);
  }
  shape.map.uv[4][0] += 0.5;
  EXPECT_FALSE(quantize_map(shape.mesh, shape.map));
}

TEST(QuantizeMap, pieces_of_surface_are_pinned_one_by_one) {
  MapShape shape = support::rectangle_map(3, 2, 3, 2), other = shape;
  const auto shift = static_cast<std::uint32_t>(shape.mesh.points.size());
  for (const Vec3& p : other.mesh.points) shape.mesh.points.push_back({p.x + 10, p.y, 0});
  for (const Triangle& t : other.mesh.triangles)
    shape.mesh.triangles.push_back({t[0] + shift, t[1] + shift, t[2] + shift});
  shape.map.uv.insert(shape.map.uv.end(), other.map.uv.begin(), other.map.uv.end());
  for (const FeatureEdge& e : other.mesh.edges) shape.mesh.edges.push_back({e.a + shift, e.b + shift, e.feature});
  for (const std::uint32_t p : other.mesh.corners) shape.mesh.corners.push_back(p + shift);
  support::finish_shape(shape);
  const Quantization q = quantize(shape);
  int pins = 0;
  for (const IntegerConstraint& row : q.constraints) pins += row.terms.size() == 1;
  EXPECT_EQ(pins, 2);
}

}  // namespace
}  // namespace strataflow
