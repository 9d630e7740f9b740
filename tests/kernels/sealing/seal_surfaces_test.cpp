#include "kernels/sealing/seal_surfaces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "base/archive.h"
#include "base/digest.h"
#include "kernels/contacts/raw_surfaces.h"
#include "support/schedules.h"

namespace strataflow {
namespace {

using support::add_grid;
using support::add_patch;
using support::raw_box;
using support::region_volumes;

CutResult sealed(const TriangleSoup& soup, const SealSurfacesOptions& options = {}) {
  Result<CutResult> result = seal_surfaces(soup, {}, options);
  EXPECT_TRUE(result) << (result ? "" : describe(result.failure()));
  return result ? *std::move(result) : CutResult{};
}

bool tells(const CutResult& result, std::string_view kind) {
  for (const Change& change : result.changes)
    if (change.kind == kind) return true;
  return false;
}

void expect_four_equal_regions(const TriangleSoup& soup) {
  const std::vector<double> volumes = region_volumes(soup);
  ASSERT_EQ(volumes.size(), 4u) << support::violations(soup);
  for (const double volume : volumes) EXPECT_NEAR(volume, 250, 1e-9);
  EXPECT_EQ(support::violations(soup), "");
}

TEST(SealSurfaces, closes_gaps_within_the_distance_into_four_regions) {
  for (const double gap : {1e-3, 0.1}) {
    const CutResult result = sealed(raw_box(gap, 4));
    expect_four_equal_regions(result.soup);
    EXPECT_TRUE(tells(result, "made_contact"));
    EXPECT_EQ(result.report.pairs_left, 0u);
  }
}

TEST(SealSurfaces, trims_what_overshoots_by_no_more_than_the_distance) {
  const CutResult result = sealed(raw_box(-0.1, 4));
  expect_four_equal_regions(result.soup);
  EXPECT_NEAR(support::area_m2(result.soup, 1), 100, 1e-9);
  EXPECT_NEAR(support::area_m2(result.soup, 2), 100, 1e-9);
}

TEST(SealSurfaces, wider_gaps_are_closed_when_the_distance_or_a_contact_says_so) {
  EXPECT_NE(region_volumes(sealed(raw_box(0.5, 3)).soup).size(), 4u);
  expect_four_equal_regions(sealed(raw_box(0.5, 3), {.distance_m = 0.7}).soup);
  expect_four_equal_regions(
      sealed(raw_box(0.5, 3), {.contacts = {"F1 -> box within 0.7", "H1 -> box within 0.9", "H1 -> F1 within 0.7"}})
          .soup);
}

TEST(SealSurfaces, a_fault_that_dies_inside_stays_a_dying_fault) {
  TriangleSoup soup = support::box({0, 0, 0}, {10, 10, 10});
  add_grid(soup, add_patch(soup, "F1", Role::fault), 4, 4, [](double u, double v) {
    return Vec3{5, 0.1 + 5.9 * u, 0.1 + 9.8 * v};
  });
  const CutResult result = sealed(soup);
  EXPECT_THAT(region_volumes(result.soup), testing::ElementsAre(testing::DoubleNear(1000, 1e-9)));
  EXPECT_NEAR(support::area_m2(result.soup, 1), 60, 0.1);
  double tip = 0;
  for (const Vec3& p : support::positions_of(result.soup, 1)) tip = std::max(tip, p.y);
  EXPECT_NEAR(tip, 6, 1e-9);
  EXPECT_NEAR(support::shared_length_m(result.soup, 1, 0), 22, 0.1);
}

TEST(SealSurfaces, what_lies_outside_the_boundary_goes_whatever_its_size_unless_asked_to_stay) {
  TriangleSoup soup = support::box({0, 0, 0}, {10, 10, 10});
  add_grid(soup, add_patch(soup, "F1", Role::fault), 3, 3, [](double u, double v) {
    return Vec3{5, -2 + 14 * u, -2 + 14 * v};
  });
  const CutResult result = sealed(soup);
  EXPECT_THAT(region_volumes(result.soup),
              testing::ElementsAre(testing::DoubleNear(500, 1e-9), testing::DoubleNear(500, 1e-9)));
  EXPECT_NEAR(support::area_m2(result.soup, 1), 100, 1e-9);
  EXPECT_TRUE(tells(result, "trimmed_outside"));
  EXPECT_NEAR(support::area_m2(sealed(soup, {.trim_outside = false}).soup, 1), 196, 1e-9);
}

TEST(SealSurfaces, two_horizons_that_nearly_coincide_leave_no_micro_region) {
  TriangleSoup soup = support::box({0, 0, 0}, {10, 10, 10});
  for (const double z : {5.0, 5.0005}) {
    const std::uint32_t patch = add_patch(soup, z > 5 ? "H2" : "H1", Role::horizon);
    add_grid(soup, patch, 2, 2, [z](double u, double v) { return Vec3{-1 + 12 * u, -1 + 12 * v, z}; });
  }
  EXPECT_EQ(region_volumes(sealed(soup, {.distance_m = 0}).soup).size(), 3u)
      << "without a distance nothing is too small";
  EXPECT_EQ(region_volumes(sealed(soup, {.distance_m = 0, .micro_region_volume_m3 = 0.1}).soup).size(), 2u);
}

TEST(SealSurfaces, a_wrong_contact_is_refused_before_anything_is_cut) {
  const Result<CutResult> result = seal_surfaces(raw_box(0.1, 2), {}, {.contacts = {"H9 -> F1"}});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.failure().code, FailureCode::invalid_options);
}

TEST(SealSurfaces, cut_surfaces_can_be_sealed_later) {
  const Result<CutResult> cut = cut_surfaces(raw_box(-0.1, 3));
  ASSERT_TRUE(cut);
  const Result<CutResult> result = seal_cut_surfaces(*cut);
  ASSERT_TRUE(result) << describe(result.failure());
  expect_four_equal_regions(result->soup);
  EXPECT_EQ(result->report.intersecting_pairs, cut->report.intersecting_pairs);
  EXPECT_GT(result->changes.size(), cut->changes.size());
}

TEST(SealSurfaces, gives_the_same_bits_on_every_schedule) {
  const TriangleSoup soup = raw_box(0.1, 4);
  const auto digest = [&] {
    ArchiveWriter bytes;
    bytes(sealed(soup));
    return digest_of(bytes.bytes());
  };
  const Digest expected = digest();
  support::on_every_schedule([&](const char* schedule) { EXPECT_EQ(digest(), expected) << schedule; }, 2);
}

TEST(SealingDistance, is_a_hundredth_of_the_diagonal_unless_said) {
  const TriangleSoup soup = support::box({0, 0, 0}, {3, 4, 12});
  EXPECT_DOUBLE_EQ(sealing_distance_m(soup, {}), 0.13);
  EXPECT_DOUBLE_EQ(sealing_distance_m(soup, {.distance_m = 2}), 2);
}

}  // namespace
}  // namespace strataflow
