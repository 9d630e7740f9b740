#include "kernels/voronoi/cvt_share.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

TEST(SumShares, adds_what_all_parts_give_a_site_and_leaves_a_site_without_any_where_it_is) {
  const std::vector<Vec3> sites{{1, 0, 0}, {5, 5, 5}};
  CvtTerms terms;
  terms.attraction = 7;
  sum_shares({{{0, 2, 10, {1, 0, 0}}}, {{0, 2, 20, {3, 4, 0}}}}, sites, terms);
  EXPECT_EQ(terms.quantization, 30);
  EXPECT_EQ(terms.attraction, 0);
  EXPECT_EQ(terms.mass, (std::vector<double>{4, 0}));
  EXPECT_EQ(terms.centroid[0], (Vec3{2, 1, 0}));
  EXPECT_EQ(terms.quantization_gradient[0], (Vec3{-8, -8, 0}));
  EXPECT_EQ(terms.centroid[1], sites[1]);
}

}  // namespace
}  // namespace strataflow
