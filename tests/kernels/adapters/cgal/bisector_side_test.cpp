#include "kernels/adapters/cgal/bisector_side.h"

#include <gtest/gtest.h>

#include <array>

namespace strataflow {
namespace {

TEST(BisectorSide, a_point_is_on_the_side_of_the_nearer_site) {
  const Vec3 x{1, 0, 0};
  EXPECT_EQ(bisector_side({&x, 1}, {{0, 0, 0}, 0}, {}, {{3, 0, 0}, 1}), 1);
  EXPECT_EQ(bisector_side({&x, 1}, {{3, 0, 0}, 1}, {}, {{0, 0, 0}, 0}), -1);
}

TEST(BisectorSide, a_tie_goes_to_the_larger_id_from_both_sides) {
  const Vec3 x{1, 0, 0};
  const PerturbedSite a{{0, 0, 0}, 4}, b{{2, 0, 0}, 7};
  EXPECT_EQ(bisector_side({&x, 1}, a, {}, b), -1);
  EXPECT_EQ(bisector_side({&x, 1}, b, {}, a), 1);
}

TEST(BisectorSide, four_sites_round_a_square_are_told_apart_alike_by_all) {
  // Their four bisectors meet in the centre of the triangle's plane: each site asks whether the vertex of itself and its
  // two neighbours is nearer to the one opposite. Perturbed, exactly one diagonal pair of sites is adjacent.
  const std::array<Vec3, 3> triangle{Vec3{-5, -5, 0}, {5, -5, 0}, {0, 8, 0}};
  const std::array<Vec3, 4> corner{Vec3{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}};
  int cut_by_opposite = 0;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const auto site = [&](std::uint32_t k) { return PerturbedSite{corner[(i + k) % 4], (i + k) % 4}; };
    const std::array<PerturbedSite, 2> beside{site(1), site(3)};
    if (bisector_side(triangle, site(0), beside, site(2)) < 0) ++cut_by_opposite;
  }
  EXPECT_EQ(cut_by_opposite, 2);
}

TEST(BisectorSide, sees_a_difference_of_one_unit_in_the_last_place) {
  const Vec3 x{1, 0, 0};
  const double almost_two = 2 + 0x1.0p-51;
  EXPECT_EQ(bisector_side({&x, 1}, {{0, 0, 0}, 0}, {}, {{almost_two, 0, 0}, 1}), 1);
}

TEST(BisectorOrientation, parallel_bisectors_have_none) {
  const std::array<Vec3, 3> triangle{Vec3{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const std::array<PerturbedSite, 2> in_line{PerturbedSite{{1, 0, 0}, 1}, PerturbedSite{{2, 0, 0}, 2}};
  EXPECT_EQ(bisector_orientation(triangle, {0, 0, 0}, in_line), 0);
  const std::array<PerturbedSite, 2> across{PerturbedSite{{1, 0, 0}, 1}, PerturbedSite{{0, 1, 0}, 2}};
  EXPECT_NE(bisector_orientation(triangle, {0, 0, 0}, across), 0);
}

}  // namespace
}  // namespace strataflow
