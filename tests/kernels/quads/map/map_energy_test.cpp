#include "kernels/quads/map/map_energy.h"

#include <gtest/gtest.h>

#include "../field/feature_shapes.h"

namespace strataflow {
namespace {

TEST(MapEnergy, finds_the_linear_part_of_a_linear_map_on_every_triangle) {
  const FeatureMesh mesh = support::wedge(3, 0.8);
  const auto layout = build_feature_layout(mesh);
  const auto shapes = triangle_shapes(*layout, 0.5);
  const std::complex<double> p(0.3, 1.2), q(-0.4, 0.2);
  for (std::uint32_t t = 0; t < shapes.size(); ++t) {
    // Places of the corners in the triangle's own plane, in quads.
    const std::array<std::complex<double>, 3> z{0.0, layout->length_m[3 * t] / 0.5,
                                                std::polar(layout->length_m[3 * t + 2] / 0.5, layout->angle[3 * t])};
    std::complex<double> found_p = 0, found_q = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::complex<double> u = p * z[k] + q * std::conj(z[k]) + 5.0;
      found_p += shapes[t].slope[k] * u;
      found_q += std::conj(shapes[t].slope[k]) * u;
    }
    EXPECT_NEAR(std::abs(found_p - p), 0, 1e-12);
    EXPECT_NEAR(std::abs(found_q - q), 0, 1e-12);
    EXPECT_NEAR(shapes[t].area, layout->area_m2[t] * 4, 1e-12);
  }
}

TEST(MapEnergy, solves_for_the_minimum_of_a_quadratic_energy_in_one_step) {
  const FeatureMesh mesh = support::square(4);
  const auto layout = build_feature_layout(mesh);
  const std::vector<std::uint8_t> turns(layout->opposite.size(), 0);
  const std::vector<MapAxis> axes(layout->opposite.size(), MapAxis::none);
  const auto reduction = reduce_map(mesh, *layout, turns, axes);
  ASSERT_TRUE(reduction);
  auto energy = MapEnergy::build(*layout, *reduction, mesh.edge_length_m);
  ASSERT_TRUE(energy);
  const auto derivatives_at = [&](const std::vector<double>& x) {
    std::vector<LinearDerivatives> all;
    for (const LinearPart& part : energy->linear_parts(x)) {
      LinearDerivatives d;
      d.gradient = {part.p.real() - 1, part.p.imag(), part.q.real(), part.q.imag()};
      for (std::size_t i = 0; i < 4; ++i) d.hessian[5 * i] = 1;
      all.push_back(d);
    }
    return all;
  };
  std::vector<double> x(energy->unknowns(), 0.25);
  ASSERT_TRUE(energy->factorize(derivatives_at(x), 0));
  const std::vector<double> step = energy->solve(energy->gradient(derivatives_at(x)));
  for (std::size_t i = 0; i < x.size(); ++i) x[i] -= step[i];
  for (const double g : energy->gradient(derivatives_at(x))) EXPECT_NEAR(g, 0, 1e-12);
}

}  // namespace
}  // namespace strataflow
