#include "kernels/cutting/coplanar_pieces.h"

#include <gtest/gtest.h>

namespace strataflow {
namespace {

TEST(CoplanarPieces, take_the_diagonal_of_the_first) {
  // One square, cut along either diagonal.
  std::vector<CutPieces> pieces{{{{0, 1, 2}, {0, 2, 3}}, {0, 0}}, {{{0, 1, 3}, {1, 2, 3}}, {0, 0}}};
  unify_coplanar_pieces(pieces, {0, 1});
  EXPECT_EQ(pieces[1].triangles, pieces[0].triangles);
}

TEST(CoplanarPieces, keep_the_way_their_own_triangle_looks) {
  std::vector<CutPieces> pieces{{{{0, 1, 2}, {0, 2, 3}}, {0, 0}}, {{{1, 0, 3}, {2, 1, 3}}, {0, 0}}};
  unify_coplanar_pieces(pieces, {0, 1});
  EXPECT_EQ(pieces[1].triangles, (std::vector<Triangle>{{0, 2, 1}, {0, 3, 2}}));
}

TEST(CoplanarPieces, of_another_area_stay) {
  std::vector<CutPieces> pieces{{{{0, 1, 2}, {0, 2, 3}}, {0, 0}}, {{{0, 1, 4}, {1, 2, 4}, {5, 6, 7}}, {0, 0, 1}}};
  const auto before = pieces[1].triangles;
  unify_coplanar_pieces(pieces, {0, 1});
  EXPECT_EQ(pieces[1].triangles, before);
}

TEST(CoplanarPieces, are_unified_pocket_by_pocket) {
  std::vector<CutPieces> pieces{{{{8, 9, 0}, {0, 1, 2}, {0, 2, 3}}, {0, 1, 1}},
                                {{{0, 1, 3}, {1, 2, 3}, {3, 2, 7}}, {0, 0, 1}},
                                {{{1, 3, 0}, {1, 2, 3}}, {0, 0}}};
  unify_coplanar_pieces(pieces, {0, 1, 2});
  EXPECT_EQ(pieces[1].triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {3, 2, 7}}));
  EXPECT_EQ(pieces[2].triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
}

}  // namespace
}  // namespace strataflow
