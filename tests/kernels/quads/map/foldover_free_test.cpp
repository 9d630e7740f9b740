#include "kernels/quads/map/foldover_free.h"

#include <gtest/gtest.h>

#include "../field/feature_shapes.h"
#include "base/seed.h"
#include "kernels/quads/map/integrate_field.h"

namespace strataflow {
namespace {

TEST(FoldoverFree, derivatives_agree_with_differences) {
  RandomStream random(1);
  for (int sample = 0; sample < 50; ++sample) {
    std::array<double, 4> at{};
    for (double& value : at) value = 2 * random.unit() - 1;
    const double epsilon = sample % 2 ? 0.3 : 1.0;
    const auto value = [&](const std::array<double, 4>& v) {
      return foldover_energy({{v[0], v[1]}, {v[2], v[3]}}, 0.7, epsilon).value;
    };
    const LinearDerivatives d = foldover_energy({{at[0], at[1]}, {at[2], at[3]}}, 0.7, epsilon);
    constexpr double h = 1e-6;
    for (std::size_t i = 0; i < 4; ++i) {
      auto up = at, down = at;
      up[i] += h;
      down[i] -= h;
      EXPECT_NEAR(d.gradient[i], (value(up) - value(down)) / (2 * h), 1e-5 * (1 + d.value * d.value / epsilon));
    }
  }
}

TEST(FoldoverFree, second_derivatives_are_exact_where_they_are_positive_and_never_negative) {
  // Near the identity the energy is convex but for turning.
  const std::array<double, 4> at{1.1, 0.05, 0.1, -0.02};
  const LinearDerivatives d = foldover_energy({{at[0], at[1]}, {at[2], at[3]}}, 0.5, 1e-9);
  constexpr double h = 1e-5;
  for (std::size_t i : {std::size_t{0}, std::size_t{2}})
    for (std::size_t j : {std::size_t{0}, std::size_t{2}}) {
      auto up = at, down = at;
      up[j] += h;
      down[j] -= h;
      const double difference = (foldover_energy({{up[0], up[1]}, {up[2], up[3]}}, 0.5, 1e-9).gradient[i] -
                                 foldover_energy({{down[0], down[1]}, {down[2], down[3]}}, 0.5, 1e-9).gradient[i]) /
                                (2 * h);
      EXPECT_NEAR(d.hessian[4 * i + j], difference, 0.05 * std::abs(difference) + 0.05);
    }
  RandomStream random(2);
  for (int sample = 0; sample < 200; ++sample) {
    std::array<double, 4> v{}, direction{};
    for (double& value : v) value = 4 * random.unit() - 2;
    for (double& value : direction) value = 2 * random.unit() - 1;
    const auto hessian = foldover_energy({{v[0], v[1]}, {v[2], v[3]}}, 0.5, 0.2).hessian;
    double quadratic = 0, scale = 0;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        quadratic += direction[i] * hessian[4 * i + j] * direction[j];
        scale += std::abs(hessian[4 * i + j]);
      }
    EXPECT_GE(quadratic, -1e-12 * scale);
  }
}

TEST(FoldoverFree, unfolds_a_square_whose_inside_was_thrown_about) {
  const FeatureMesh mesh = support::square(6);
  const auto layout = build_feature_layout(mesh);
  const std::vector<std::uint8_t> turns(layout->opposite.size(), 0);
  std::vector<MapAxis> axes(layout->opposite.size(), MapAxis::none);
  for (std::uint32_t h = 0; h < axes.size(); ++h)
    if (layout->is_feature[h])
      axes[h] = layout->feature[h] % 2 == 0 ? MapAxis::real : MapAxis::imaginary;
  const auto reduction = reduce_map(mesh, *layout, turns, axes);
  auto energy = MapEnergy::build(*layout, *reduction, mesh.edge_length_m);
  FrameField flat;
  for (std::uint32_t t = 0; t < layout->triangle_count(); ++t) {
    const Vec3 edge = mesh.points[mesh.triangles[t][1]] - mesh.points[mesh.triangles[t][0]];
    const double a = -std::atan2(edge.y, edge.x);
    flat.angles.push_back({a, a + 1.5707963267948966});
  }
  RandomStream random(3);
  std::vector<double> x = *integrate_field(*reduction, flat, *energy);
  for (double& value : x) value += 1.2 * (random.unit() - 0.5);  // edges are 0.5 long
  const auto report = make_foldover_free(*energy, x, {});
  ASSERT_TRUE(report);
  EXPECT_GT(report->flipped_before, 10);
  EXPECT_EQ(report->flipped, 0);
  EXPECT_NEAR(report->energy, 3, 1e-2);  // an isometry: 2 + 2 · 0.5
}

}  // namespace
}  // namespace strataflow
