#include "kernels/quads/quantization/optimise_vectors.h"

#include <gtest/gtest.h>

#include "kernels/quads/quantization/close_vectors.h"
#include "kernels/quads/quantization/cut_chart.h"
#include "kernels/quads/quantization/decimate_map.h"
#include "kernels/quads/quantization/round_map.h"
#include "map_shapes.h"

namespace strataflow {
namespace {

using support::MapShape;
constexpr std::uint32_t outside = FlatMesh::outside;

FlatMesh decimated(const MapShape& shape) {
  const auto flat = round_map(shape.mesh, shape.map);
  EXPECT_TRUE(flat) << describe(flat.failure());
  return decimate_map(shape.mesh, *flat, cut_chart(*flat)).mesh;
}

/// Rule R16, exactly: closed, seamed, positive, cone angles as in the map, goals met except where listed.
void expect_valid(const FlatMesh& mesh, const VectorTargets& targets, const IntegerVectors& result) {
  const auto& v = result.vectors;
  std::vector<int> quarters, wanted;
  for (std::uint32_t h = 0; h < v.size(); ++h) {
    if (h % 3 == 0) {
      ASSERT_GT(cross(v[h], v[h + 1]), 0);
      ASSERT_EQ(v[h] + v[h + 1] + v[h + 2], GaussianInteger{});
    }
    if (mesh.opposite[h] != outside) {
      ASSERT_EQ(v[h], -turned(v[mesh.opposite[h]], mesh.turns[h]));
    }
    if (!std::binary_search(result.unmet.begin(), result.unmet.end(), h)) {
      if (targets.goals[h] & fixed_real) {
        EXPECT_EQ(v[h].re, targets.goal[h].re);
      }
      if (targets.goals[h] & fixed_imaginary) {
        EXPECT_EQ(v[h].im, targets.goal[h].im);
      }
    }
    const std::size_t p = mesh.origin[h];
    if (quarters.size() <= p) quarters.resize(p + 1), wanted.resize(p + 1);
    quarters[p] += (quadrant(-v[FlatMesh::before(h)]) - quadrant(v[h])) & 3;
    wanted[p] += mesh.corner_quarters(h);
  }
  EXPECT_EQ(quarters, wanted);
  EXPECT_LE(result.energy, result.energy_before);
}

std::int64_t area(const std::vector<GaussianInteger>& v) {
  std::int64_t twice = 0;
  for (std::size_t h = 0; h < v.size(); h += 3) twice += cross(v[h], v[h + 1]);
  return twice / 2;
}

IntegerVectors optimise(const FlatMesh& mesh, double scale = 1) {
  const VectorTargets targets = targets_of(mesh, scale);
  const auto result = optimise_vectors(mesh, targets);
  EXPECT_TRUE(result) << (result ? "" : describe(result.failure()));
  expect_valid(mesh, targets, *result);
  return *result;
}

// T22.
TEST(OptimiseVectors, a_box_becomes_the_box_with_rounded_sides) {
  for (const auto& [sides, quads] : std::vector<std::pair<std::array<double, 3>, std::int64_t>>{
           {{3.73, 5.51, 1.82}, 88}, {{11.34, 7.81, 1.22}, 214}, {{1.06, 1.08, 2.87}, 14}})
    EXPECT_EQ(area(optimise(decimated(support::box_map(sides[0], sides[1], sides[2], 7))).vectors), quads);
}

TEST(OptimiseVectors, random_boxes_become_rounded_boxes_and_tiny_ones_the_unit_cube) {
  RandomStream random(5);
  int rounded = 0, unit = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    std::array<double, 3> s{};
    std::array<std::int64_t, 3> r{};
    for (std::size_t k = 0; k < 3; ++k) {
      s[k] = 0.3 + 12 * random.unit();
      r[k] = std::max<std::int64_t>(1, std::llround(s[k]));
    }
    const FlatMesh mesh = decimated(support::box_map(s[0], s[1], s[2], seed));
    rounded += area(optimise(mesh).vectors) == 2 * (r[0] * r[1] + r[1] * r[2] + r[0] * r[2]);
    unit += area(optimise(mesh, 0.01).vectors) == 6;  // T23
  }
  EXPECT_GE(rounded, 98);
  EXPECT_GE(unit, 98);
}

TEST(OptimiseVectors, many_cone_points_stay_valid_coarse_and_fine) {
  for (std::uint64_t seed = 0; seed < 25; ++seed)
    for (const double scale : {1.0, 0.02}) {
      const FlatMesh mesh = decimated(support::terrain_map(3, seed));
      optimise(mesh, scale);
    }
}

// The rounding of Kälberer and Bommes in one step (S36): the nearest integers, closed, nothing else.
bool is_rounding_valid(const FlatMesh& mesh, double scale) {
  std::vector<GaussianInteger> v(mesh.half_edge_count());
  for (std::uint32_t h = 0; h < v.size(); ++h) {
    if (mesh.opposite[h] < h) continue;
    v[h] = {std::llround(static_cast<double>(mesh.vector[h].re) * mesh.step * scale),
            std::llround(static_cast<double>(mesh.vector[h].im) * mesh.step * scale)};
    if (mesh.opposite[h] != outside) v[mesh.opposite[h]] = -turned(v[h], mesh.turns[mesh.opposite[h]]);
  }
  if (!close_vectors(mesh, std::vector<std::uint8_t>(v.size(), 0), v)) return false;
  for (std::size_t h = 0; h < v.size(); h += 3)
    if (cross(v[h], v[h + 1]) <= 0) return false;
  return true;
}

TEST(OptimiseVectors, is_valid_where_plain_rounding_is_not) {
  int rounding = 0, ours = 0;
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    const FlatMesh mesh = decimated(support::terrain_map(3, seed));
    rounding += is_rounding_valid(mesh, 0.4);
    ours += static_cast<bool>(optimise_vectors(mesh, targets_of(mesh, 0.4)));
  }
  EXPECT_EQ(ours, 25);
  EXPECT_LE(rounding, 5);
}

// T26: a tip at distance d from a feature needs 2^n·d ≥ 1/2 before long edges nearby are not flat.
TEST(OptimiseVectors, a_tip_near_a_feature_starts_from_a_multiple_of_the_map) {
  MapShape shape = support::rectangle_map(10, 6, 10, 6);
  for (std::uint32_t i = 0; i <= 10; ++i) support::move_point(shape, 11 + i, i, 0.004);
  support::add_feature(shape, {14, 15, 16, 17, 18}, "close to the south side");
  support::finish_shape(shape);
  const IntegerVectors result = optimise(decimated(shape));
  EXPECT_GE(result.doublings, 6);
  EXPECT_LE(result.doublings, 8);
  EXPECT_EQ(area(result.vectors), 70) << "one row is squeezed in: 10 × 7";
}

TEST(OptimiseVectors, boundaries_and_inner_features_stay_on_their_axes) {
  MapShape shape = support::rectangle_map(8.3, 6.4, 8, 6);
  support::add_feature(shape, {20, 21, 22, 23, 24}, "tip inside");
  support::add_feature(shape, {45, 46, 47, 48, 49}, "from the west side");
  support::finish_shape(shape);
  support::rechart(shape, 3);
  const IntegerVectors result = optimise(decimated(shape));
  EXPECT_TRUE(result.unmet.empty());
  EXPECT_EQ(area(result.vectors), 48);
}

// T28.
TEST(OptimiseVectors, a_feature_three_degrees_off_its_axis_is_aligned_by_the_descent) {
  MapShape shape = support::rectangle_map(12, 8, 12, 8);
  const double slope = std::tan(3 * M_PI / 180);
  for (std::uint32_t k = 0; k <= 6; ++k) support::move_point(shape, 4 * 13 + 3 + k, 3 + k, 4.2 + slope * k);
  support::add_feature(shape, {55, 56, 57, 58, 59, 60, 61}, "crooked");
  support::finish_shape(shape);
  const IntegerVectors result = optimise(decimated(shape));
  EXPECT_TRUE(result.unmet.empty());
  EXPECT_EQ(area(result.vectors), 96);
  // Ten times as fine the two ends are three rows apart in the map, and must meet in the descent.
  EXPECT_TRUE(optimise(decimated(shape), 10).unmet.empty());
}

TEST(OptimiseVectors, gives_the_same_bits_again) {
  const FlatMesh mesh = decimated(support::terrain_map(4, 9));
  const IntegerVectors a = optimise(mesh), b = optimise(mesh);
  EXPECT_EQ(a.vectors, b.vectors);
  EXPECT_EQ(a.energy, b.energy);
}

TEST(OptimiseVectors, what_cannot_be_positive_is_refused) {
  FlatMesh mesh = decimated(support::box_map(2, 3, 4, 1));
  VectorTargets targets = targets_of(mesh, 1);
  for (std::uint32_t h = 0; h < mesh.half_edge_count(); ++h) targets.map[h] = targets.wanted[h] = 0;
  const auto result = optimise_vectors(mesh, targets);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.failure().code, FailureCode::geometry_failed);
}

}  // namespace
}  // namespace strataflow
