#include "kernels/quads/field/polynomial_field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "base/seed.h"
#include "feature_shapes.h"
#include "kernels/quads/field/cross_field.h"
#include "kernels/quads/field/frame_field.h"
#include "kernels/quads/field/separate_features.h"
#include "kernels/quads/field/straighten_angles.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

Complex doubled(double angle) { return std::polar(1.0, 2 * angle); }

/// T16: formula (3.13) against the Fourier transform of 8 Σ ⟨u, s⟩⁴.
TEST(PolynomialField, coefficients_are_those_of_the_polynomial_on_the_circle) {
  RandomStream random(1);
  for (int sample = 0; sample < 20; ++sample) {
    const double a = 7 * random.unit(), b = 7 * random.unit();
    Complex second = 0, fourth = 0;
    constexpr int samples = 64;
    for (int k = 0; k < samples; ++k) {
      const double t = 2 * pi * k / samples;
      const double p = 8 * (std::pow(std::cos(t - a), 4) + std::pow(std::cos(t - b), 4));
      second += p * std::polar(2.0 / samples, 2 * t);
      fourth += p * std::polar(2.0 / samples, 4 * t);
    }
    const FrameCoefficients c = frame_coefficients(doubled(a), doubled(b), FrameDistance::polynomial);
    EXPECT_NEAR(std::abs(c.second - second), 0, 1e-12);
    EXPECT_NEAR(std::abs(c.fourth - fourth), 0, 1e-12);
  }
}

/// T16: formula (3.26), and c2 = 0 exactly for crosses.
TEST(PolynomialField, coefficients_agree_with_polyvectors_as_the_thesis_says) {
  RandomStream random(2);
  for (int sample = 0; sample < 20; ++sample) {
    const double a = 7 * random.unit(), b = 7 * random.unit();
    const FrameCoefficients c = frame_coefficients(doubled(a), doubled(b), FrameDistance::polynomial);
    const FrameCoefficients p = frame_coefficients(doubled(a), doubled(b), FrameDistance::polyvector);
    EXPECT_NEAR(std::abs(c.second - 4.0 * p.second), 0, 1e-12);
    EXPECT_NEAR(std::abs(c.fourth - 2 * std::cos(2 * a - 2 * b) * p.fourth), 0, 1e-12);
    EXPECT_NEAR(std::abs(frame_coefficients(doubled(a), doubled(a + pi / 2), FrameDistance::polynomial).second), 0, 1e-12);
  }
}

/// T17: Proposition 3.1. Σ_j ⟨u_j, s⟩^{2k} over a regular star of N lines does not depend on how it is turned for k < N,
/// and does for k = N.
TEST(PolynomialField, stars_hide_from_polynomials_of_too_low_degree) {
  for (int lines = 2; lines <= 5; ++lines)
    for (int k = 1; k <= lines + 1; ++k) {
      double spread = 0;
      for (const double turn : {0.1, 0.37, 0.9}) {
        double first = 0, now = 0;
        for (int j = 0; j < lines; ++j) {
          first += std::pow(std::cos(j * pi / lines), 2 * k);
          now += std::pow(std::cos(j * pi / lines + turn), 2 * k);
        }
        spread = std::max(spread, std::abs(now - first));
      }
      if (k < lines) {
        EXPECT_LT(spread, 1e-12);
      } else if (k == lines) {
        EXPECT_GT(spread, 1e-3);
      }
    }
}

/// T18: descends from a random pair of directions to another one and tells whether they keep their order.
bool keeps_order(std::array<double, 2> from, std::array<double, 2> to, FrameDistance distance) {
  const FrameCoefficients goal = frame_coefficients(doubled(to[0]), doubled(to[1]), distance);
  const double weight = distance == FrameDistance::polynomial ? 0.25 : 1;  // λ = 0.5, squared
  const auto energy = [&](double a, double b) {
    const FrameCoefficients c = frame_coefficients(doubled(a), doubled(b), distance);
    return weight * std::norm(c.second - goal.second) + std::norm(c.fourth - goal.fourth);
  };
  double step = 0.01;
  for (int i = 0; i < 600 && step > 1e-9; ++i) {
    constexpr double h = 1e-6;
    const double ga = (energy(from[0] + h, from[1]) - energy(from[0] - h, from[1])) / (2 * h);
    const double gb = (energy(from[0], from[1] + h) - energy(from[0], from[1] - h)) / (2 * h);
    const double next = energy(from[0] - step * ga, from[1] - step * gb);
    if (next > energy(from[0], from[1])) {
      step /= 2;
      continue;
    }
    from = {from[0] - step * ga, from[1] - step * gb};
    step *= 1.2;
  }
  const auto off = [](double x) { return std::abs(std::remainder(x, pi)); };
  return off(from[0] - to[0]) + off(from[1] - to[1]) <= off(from[0] - to[1]) + off(from[1] - to[0]);
}

TEST(PolynomialField, pairs_directions_like_polyvectors_in_most_cases) {
  RandomStream random(3);
  int same = 0;
  constexpr int samples = 800;
  for (int sample = 0; sample < samples; ++sample) {
    const std::array<double, 2> from{pi * random.unit(), pi * random.unit()}, to{pi * random.unit(), pi * random.unit()};
    same += keeps_order(from, to, FrameDistance::polynomial) == keeps_order(from, to, FrameDistance::polyvector);
  }
  EXPECT_NEAR(static_cast<double>(same) / samples, 0.88, 0.04);
}

PolynomialField field_of(const FeatureMesh& mesh, const PolynomialFieldOptions& options = {}) {
  const auto layout = build_feature_layout(mesh);
  return compute_polynomial_field(*layout, *smooth_cross_field(mesh, *layout, layout->angle), options);
}

/// R10 and R11.
TEST(PolynomialField, never_raises_its_energy_within_a_step_and_reproduces_constraints) {
  const FeatureMesh mesh = *separate_features(support::disc(6));
  const auto layout = build_feature_layout(mesh);
  const PolynomialField field = field_of(mesh);
  ASSERT_GE(field.iterations, 1);
  for (std::size_t i = 0; i + 1 < field.energies.size(); i += 2) EXPECT_LE(field.energies[i + 1], field.energies[i]);
  for (std::uint32_t h = 0; h < layout->opposite.size(); ++h) {
    if (!layout->is_feature[h]) continue;
    const double normal = half_edge_direction(layout->angle, h) + pi / 2;
    EXPECT_NEAR(std::sin(field.frames[h / 3][0] - normal), 0, 1e-15);
  }
  for (const auto& [a, b] : field.frames) EXPECT_GT(std::sin(b - a), 0.05);
}

/// T14: the parallelogram.
TEST(PolynomialField, is_constant_and_oblique_in_a_parallelogram) {
  const FeatureMesh mesh = support::sided_grid(
      8, 8, [](double x, double y) { return Vec3{x + y * std::cos(1.0), y * std::sin(1.0), 0}; });
  const PolynomialField field = field_of(mesh, {.iterations = 60, .inner = 100, .settled_ratio = 1e-7});
  for (const auto& [a, b] : field.frames) EXPECT_NEAR(std::sin(b - a), std::sin(1.0), 1e-2);
}

/// T14: the wedge of 15° cut so that a triangle holds both sides.
TEST(PolynomialField, stands_on_both_sides_of_an_acute_corner) {
  const FeatureMesh mesh = support::wedge(10, 15 * pi / 180);
  const PolynomialField field = field_of(mesh, {.iterations = 30});
  EXPECT_NEAR(std::sin(field.frames[0][1] - field.frames[0][0]), std::sin(15 * pi / 180), 1e-12);
  EXPECT_LT(std::sin(field.frames[2][1] - field.frames[2][0]), 0.8);  // its neighbour is oblique as well
}

/// T15: singular points lie on the boundary, from where they must be led away, then inside, ever further from it.
TEST(PolynomialField, lets_singular_points_go_to_the_boundary_where_lambda_is_small) {
  const FeatureMesh mesh = *separate_features(support::disc(10));
  const auto field = [&](double lambda) {
    return *compute_frame_field(mesh, {.kind = "polynomial", .lambda = lambda, .iterations = 20});
  };
  const auto mean_radius = [&](const FrameFieldResult& result) {
    double sum = 0, count = 0;
    for (std::size_t p = 0; p < mesh.points.size(); ++p)
      if (result.field.valence[p] == 3) {
        sum += std::hypot(mesh.points[p].x, mesh.points[p].y);
        ++count;
      }
    return sum / count;
  };
  EXPECT_GE(field(0.1).report.off_features, 4);
  const FrameFieldResult middle = field(1.5), large = field(50);
  EXPECT_EQ(middle.report.off_features + large.report.off_features, 0);
  EXPECT_EQ(large.report.valence_3, 4);
  EXPECT_LT(mean_radius(large), 0.8 * mean_radius(middle));
}

/// T15: the mean obliqueness falls as λ grows.
TEST(PolynomialField, becomes_a_cross_field_as_lambda_grows) {
  const FeatureMesh mesh = *separate_features(support::disc(6));
  double before = 2;
  for (const double lambda : {0.1, 0.5, 1.5, 50.0}) {
    double oblique = 0;
    const PolynomialField field = field_of(mesh, {.lambda = lambda, .iterations = 20});
    for (const auto& [a, b] : field.frames) oblique += std::abs(std::cos(b - a)) / static_cast<double>(field.frames.size());
    EXPECT_LT(oblique, before) << lambda;
    before = oblique;
  }
  EXPECT_LT(before, 0.02);
}

TEST(PolynomialField, makes_valid_frame_fields) {
  for (const char* kind : {"polynomial", "polyvector"}) {
    FrameFieldOptions options;
    options.kind = kind;
    for (const FeatureMesh& mesh : {support::square(8), support::disc(8), support::square_with_fault(12)}) {
      const auto result = compute_frame_field(*separate_features(mesh), options);
      ASSERT_TRUE(result) << describe(result.failure());
      EXPECT_EQ(result->report.index_sum, 4 * result->report.euler);
      EXPECT_EQ(result->report.feature_irregular, 0);
    }
  }
}

TEST(PolynomialField, is_the_same_on_every_schedule) {
  const FeatureMesh mesh = support::disc(10);
  const auto expected = field_of(mesh).frames;
  support::on_every_schedule([&](const char* schedule) { EXPECT_EQ(field_of(mesh).frames, expected) << schedule; }, 2);
}

}  // namespace
}  // namespace strataflow
