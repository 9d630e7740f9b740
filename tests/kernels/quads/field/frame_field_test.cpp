#include "kernels/quads/field/frame_field.h"

#include <gtest/gtest.h>

#include "base/archive.h"
#include "base/digest.h"
#include "feature_shapes.h"
#include "kernels/quads/field/separate_features.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

FrameFieldResult field_of(const FeatureMesh& mesh, const FrameFieldOptions& options = {}) {
  const auto result = compute_frame_field(*separate_features(mesh), options);
  EXPECT_TRUE(result) << describe(result.failure());
  if (!result) return {};
  EXPECT_EQ(result->report.index_sum, 4 * result->report.euler);
  return *result;
}

/// T14 for the fast field.
TEST(FrameField, has_the_singular_points_that_the_shape_asks_for) {
  const FrameFieldReport square = field_of(support::square(8)).report;
  EXPECT_EQ(square.valence_3 + square.valence_5 + square.valence_other, 0);
  const FrameFieldReport fault = field_of(support::square_with_fault(16)).report;
  EXPECT_EQ(fault.valence_3 + fault.valence_5 + fault.valence_other + fault.feature_irregular, 0);
  const FrameFieldReport disc = field_of(support::disc(10)).report;
  EXPECT_EQ(disc.valence_3, 4);
  EXPECT_EQ(disc.valence_5 + disc.valence_other, 0);
  const FrameFieldReport box = field_of(support::box_surface(1, 2, 3, 4)).report;
  EXPECT_EQ(box.valence_3 + box.valence_5 + box.valence_other, 0);
  EXPECT_EQ(box.feature_irregular, 8);
  const FeatureMesh l_shape = [] {
    FeatureMesh mesh = support::bare_grid(8, 8, [](double x, double y) { return Vec3{8 * x, 8 * y, 0}; },
                                          [](std::uint32_t i, std::uint32_t j) { return i < 4 || j < 4; });
    std::vector<std::uint32_t> rim = support::grid_path(0, 8, 1);
    for (const auto& [from, to, step] : {std::array{8, 44, 9}, {44, 40, -1}, {40, 76, 9}, {76, 72, -1}, {72, 0, -9}}) {
      const auto side = support::grid_path(static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to), step);
      rim.insert(rim.end(), side.begin() + 1, side.end());
    }
    support::add_feature(mesh, "rim", rim);
    support::add_corners(mesh, {0, 8, 44, 40, 76, 72});
    return mesh;
  }();
  const FrameFieldReport bent = field_of(l_shape).report;
  EXPECT_EQ(bent.valence_3 + bent.valence_5 + bent.valence_other, 0) << "the reentrant corner takes three quads";
  const FrameFieldReport torus = field_of(support::torus(24, 12)).report;
  EXPECT_EQ(torus.valence_3, torus.valence_5);
}

TEST(FrameField, keeps_acute_corners_free_of_extra_singular_points_down_to_two_degrees) {
  for (const double degrees : {2.0, 5.0, 15.0, 30.0, 60.0}) {
    const FrameFieldResult result = field_of(support::wedge(12, degrees * 3.14159265358979 / 180));
    EXPECT_EQ(result.report.valence_3, 1) << degrees;  // a triangle needs one
    EXPECT_EQ(result.report.valence_5 + result.report.valence_other, 0) << degrees;
    EXPECT_GT(result.field.smallest_sine, 0) << degrees;
  }
}

TEST(FrameField, is_the_same_on_every_schedule) {
  const FeatureMesh mesh = *separate_features(support::wedge(20, 0.2));
  const auto digest_now = [&] { return digest_of(archived(compute_frame_field(mesh)->field)); };
  const auto expected = digest_now();
  support::on_every_schedule([&](const char* schedule) { EXPECT_EQ(digest_now(), expected) << schedule; }, 2);
}

TEST(FrameField, wants_features_kept_apart) {
  FeatureMesh mesh = support::wedge(2, 0.4);
  EXPECT_FALSE(compute_frame_field(mesh));
}

}  // namespace
}  // namespace strataflow
