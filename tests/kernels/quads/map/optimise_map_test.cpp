#include "kernels/quads/map/optimise_map.h"

#include <gtest/gtest.h>

#include "../field/feature_shapes.h"
#include "kernels/quads/field/frame_field.h"
#include "kernels/quads/field/separate_features.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

/// R13 and R19 of the map of a shape.
void expect_a_valid_map(const FeatureMesh& raw, const std::string& what) {
  const FeatureMesh mesh = *separate_features(raw);
  const auto field = compute_frame_field(mesh);
  ASSERT_TRUE(field) << what << ": " << describe(field.failure());
  const auto optimised = optimise_map(mesh, field->field);
  ASSERT_TRUE(optimised) << what << ": " << describe(optimised.failure());
  const auto defects = measure_map(mesh, optimised->map);
  ASSERT_TRUE(defects);
  EXPECT_LT(defects->seam, 1e-10) << what;
  EXPECT_EQ(defects->off_axis, 0) << what;
  EXPECT_EQ(defects->flipped, 0) << what;
  EXPECT_EQ(defects->wrong_angles, 0) << what;
}

TEST(OptimiseMap, is_seamless_aligned_and_without_folds) {
  expect_a_valid_map(support::square(6), "square");
  expect_a_valid_map(support::square_with_fault(12), "fault");
  expect_a_valid_map(support::disc(8), "disc");
  expect_a_valid_map(support::box_surface(3.7, 5.5, 1.8, 5), "box");
  expect_a_valid_map(support::torus(24, 12), "torus");
  for (const double degrees : {2.0, 5.0, 15.0, 45.0, 100.0})
    expect_a_valid_map(support::wedge(12, degrees * 3.14159265358979 / 180), "wedge of " + std::to_string(degrees));
}

TEST(OptimiseMap, keeps_lengths_where_the_shape_lets_it) {
  FeatureMesh mesh = *separate_features(support::box_surface(3, 2, 1, 5));
  mesh.edge_length_m = 0.5;
  const auto optimised = optimise_map(mesh, compute_frame_field(mesh)->field);
  ASSERT_TRUE(optimised);
  const auto layout = build_feature_layout(mesh);
  for (std::uint32_t h = 0; h < layout->opposite.size(); ++h) {
    const double mapped = std::abs(optimised->map.at(next_half_edge(h)) - optimised->map.at(h));
    EXPECT_NEAR(mapped, layout->length_m[h] / 0.5, 1e-3);
  }
}

/// T27 for the seamless map: a free boundary is not aligned, an aligned one is.
TEST(OptimiseMap, leaves_a_free_boundary_free) {
  FeatureMesh mesh = support::bare_grid(10, 10, [](double x, double y) { return Vec3{x, y + 0.3 * x * x, 0}; });
  support::add_feature(mesh, "fault", support::grid_path(5 * 11 + 3, 5 * 11 + 7, 1));
  mesh = *separate_features(mesh);
  const auto field = compute_frame_field(mesh);
  ASSERT_TRUE(field) << describe(field.failure());
  const auto optimised = optimise_map(mesh, field->field);
  ASSERT_TRUE(optimised) << describe(optimised.failure());
  const auto defects = measure_map(mesh, optimised->map);
  EXPECT_EQ(defects->flipped + defects->wrong_angles, 0);
  EXPECT_EQ(defects->off_axis, 0);
  const auto layout = build_feature_layout(mesh);
  double off_axis = 0;
  for (std::uint32_t h = 0; h < layout->opposite.size(); ++h)
    if (layout->opposite[h] == no_index) {
      const auto along = optimised->map.at(next_half_edge(h)) - optimised->map.at(h);
      off_axis = std::max(off_axis, std::min(std::abs(along.real()), std::abs(along.imag())));
    }
  EXPECT_GT(off_axis, 1e-3);
}

TEST(OptimiseMap, starts_again_from_an_earlier_map_under_new_constraints) {
  const FeatureMesh mesh = *separate_features(support::square(6));
  const FrameField field = compute_frame_field(mesh)->field;
  const auto seamless = optimise_map(mesh, field);
  ASSERT_TRUE(seamless);
  const auto layout = build_feature_layout(mesh);
  std::uint32_t h = 0;
  while (field.axes[h] != MapAxis::real) ++h;
  const double before = (seamless->map.at(next_half_edge(h)) - seamless->map.at(h)).real();
  const std::int64_t asked = before > 0 ? 2 : -2;
  const std::vector<IntegerConstraint> constraints{{{{next_half_edge(h), {1, 0}}, {h, {-1, 0}}}, {asked, 0}}};
  const auto again = optimise_map(mesh, field, constraints, &seamless->map);
  ASSERT_TRUE(again) << describe(again.failure());
  EXPECT_EQ(measure_map(mesh, again->map)->flipped, 0);
  EXPECT_NEAR((again->map.at(next_half_edge(h)) - again->map.at(h)).real(), static_cast<double>(asked), 1e-12);
  // A side that shall run backwards cannot be reached without a fold.
  const std::vector<IntegerConstraint> backwards{{{{next_half_edge(h), {1, 0}}, {h, {-1, 0}}}, {-asked, 0}}};
  FoldoverFreeOptions options;
  options.may_start_afresh = false;
  const auto stuck = optimise_map(mesh, field, backwards, &seamless->map, options);
  ASSERT_FALSE(stuck);
  EXPECT_NE(stuck.failure().what.find("carried over"), std::string::npos) << stuck.failure().what;
}

TEST(OptimiseMap, is_the_same_on_every_schedule) {
  const FeatureMesh mesh = *separate_features(support::wedge(24, 0.4));
  const FrameField field = compute_frame_field(mesh)->field;
  const auto expected = optimise_map(mesh, field)->map.uv;
  support::on_every_schedule(
      [&](const char* schedule) { EXPECT_EQ(optimise_map(mesh, field)->map.uv, expected) << schedule; }, 2);
}

}  // namespace
}  // namespace strataflow
