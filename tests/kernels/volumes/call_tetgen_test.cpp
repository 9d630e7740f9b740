#include "kernels/adapters/tetgen/call_tetgen.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/archive.h"
#include "kernels/adapters/cgal/exact_predicates.h"

namespace strataflow {
namespace {

TetgenRequest tetrahedron() {
  return {"pYQ", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}, 0};
}

TEST(CallTetgen, gives_positive_tetrahedra_and_the_facet_of_each_subface) {
  const TetgenResponse response = call_tetgen(tetrahedron());
  ASSERT_EQ(response.error, 0);
  ASSERT_EQ(response.points, tetrahedron().points);
  ASSERT_EQ(response.tets.size(), 1u);
  const auto& tet = response.tets[0];
  EXPECT_EQ(orientation_3d(response.points[tet[0]], response.points[tet[1]], response.points[tet[2]],
                           response.points[tet[3]]),
            1);
  std::vector<std::uint32_t> facets = response.subface_facet;
  std::sort(facets.begin(), facets.end());
  EXPECT_EQ(facets, (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

TEST(CallTetgen, gives_the_same_bytes_for_the_same_request) {
  TetgenRequest request = tetrahedron();
  request.switches = "pqQa0.001";
  const TetgenResponse first = call_tetgen(request);
  EXPECT_GT(first.tets.size(), 100u);
  EXPECT_EQ(archived(first), archived(call_tetgen(request)));
}

TEST(CallTetgen, its_exchange_survives_the_pipe_and_damage_is_noticed) {
  const TetgenResponse response = call_tetgen(tetrahedron());
  std::vector<std::byte> bytes = archived(response);
  const auto back = unarchived<TetgenResponse>(bytes);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->tets, response.tets);
  bytes.pop_back();
  EXPECT_FALSE(unarchived<TetgenResponse>(bytes).has_value());
}

}  // namespace
}  // namespace strataflow
