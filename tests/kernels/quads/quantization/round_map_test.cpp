#include "kernels/quads/quantization/round_map.h"

#include <gtest/gtest.h>

#include "map_shapes.h"

namespace strataflow {
namespace {

using support::MapShape;

TEST(RoundMap, a_noisy_seamless_map_becomes_exact_and_moves_by_less_than_its_noise) {
  MapShape shape = support::box_map(3.7, 5.5, 1.8, 2);
  support::insert_points(shape, 50, 1);
  RandomStream random(9);
  for (auto& z : shape.map.uv)
    for (double& x : z) x += 1e-10 * (random.unit() - 0.5);
  const auto flat = round_map(shape.mesh, shape.map);
  ASSERT_TRUE(flat) << describe(flat.failure());
  for (std::uint32_t h = 0; h < flat->half_edge_count(); ++h) {
    if (h % 3 == 0) {
      EXPECT_EQ(flat->vector[h] + flat->vector[h + 1] + flat->vector[h + 2], GaussianInteger{});
    }
    EXPECT_EQ(flat->vector[h], -turned(flat->vector[flat->opposite[h]], flat->turns[h]));
    const auto own = shape.map.at(FlatMesh::next(h)) - shape.map.at(h);
    EXPECT_NEAR(static_cast<double>(flat->vector[h].re) * flat->step, own.real(), 2e-9);
    EXPECT_NEAR(static_cast<double>(flat->vector[h].im) * flat->step, own.imag(), 2e-9);
  }
}

TEST(RoundMap, features_become_exactly_straight) {
  MapShape shape = support::rectangle_map(4, 3, 4, 3);
  support::finish_shape(shape);
  RandomStream random(3);
  for (auto& z : shape.map.uv)
    for (double& x : z) x += 1e-11 * (random.unit() - 0.5);
  const auto flat = round_map(shape.mesh, shape.map);
  ASSERT_TRUE(flat) << describe(flat.failure());
  int on_features = 0;
  for (std::uint32_t h = 0; h < flat->half_edge_count(); ++h) {
    if (flat->axis[h] == MapAxis::real) {
      EXPECT_EQ(flat->vector[h].im, 0);
    }
    if (flat->axis[h] == MapAxis::imaginary) {
      EXPECT_EQ(flat->vector[h].re, 0);
    }
    on_features += flat->curve[h] > 1;
  }
  EXPECT_EQ(on_features, 14);
}

TEST(RoundMap, names_what_is_not_seamless_not_positive_not_finite_or_not_manifold) {
  MapShape good = support::rectangle_map(2, 2, 2, 2);
  support::finish_shape(good);
  MapShape torn = good;
  torn.map.uv[0][0] += 0.01;
  auto failed = round_map(torn.mesh, torn.map);
  ASSERT_FALSE(failed);
  EXPECT_NE(failed.failure().what.find("not seamless across edge"), std::string::npos);

  MapShape folded = good;
  support::move_point(folded, 4, 2.5, 1);
  failed = round_map(folded.mesh, folded.map);
  ASSERT_FALSE(failed);
  EXPECT_NE(failed.failure().what.find("is not positive"), std::string::npos);

  MapShape lost = good;
  lost.map.uv[5][1] = std::nan("");
  failed = round_map(lost.mesh, lost.map);
  ASSERT_FALSE(failed);
  EXPECT_NE(failed.failure().what.find("triangle 1"), std::string::npos);

  MapShape doubled = good;
  doubled.mesh.triangles.push_back(doubled.mesh.triangles[0]);
  doubled.map.uv.insert(doubled.map.uv.end(), 3, {0, 0});
  doubled.map.turns.resize(27);
  doubled.map.axes.resize(27);
  failed = round_map(doubled.mesh, doubled.map);
  ASSERT_FALSE(failed);
  EXPECT_NE(failed.failure().what.find("manifold"), std::string::npos);

  MapShape pinched = good;  // two opposite cells of the four: they share the middle point only
  for (const int cell : {2, 1}) {
    pinched.mesh.triangles.erase(pinched.mesh.triangles.begin() + 2 * cell,
                                 pinched.mesh.triangles.begin() + 2 * cell + 2);
    pinched.map.uv.erase(pinched.map.uv.begin() + 6 * cell, pinched.map.uv.begin() + 6 * cell + 6);
  }
  support::finish_map(pinched);
  failed = round_map(pinched.mesh, pinched.map);
  ASSERT_FALSE(failed);
  EXPECT_NE(failed.failure().what.find("point 4"), std::string::npos);

  MapShape shorter = good;
  shorter.map.uv.pop_back();
  EXPECT_FALSE(round_map(shorter.mesh, shorter.map));
}

}  // namespace
}  // namespace strataflow
