#include "kernels/hexes/upright_system.h"

#include <gtest/gtest.h>

#include "kernels/hexes/tet_models.h"

namespace strataflow {
namespace {

TEST(UprightSystem, substitutes_constraints_that_hang_on_others) {
  // 2 = ¼ · 0 + ¾ · 1; 3 = ½ · 2 + ½ · 1; 4 = 3.
  const UprightSystem system = substitute(5, {{2, 0, 1, 0.25, 0}, {3, 2, 1, 0.5, 0}, {4, 3, 3, 1, 0}});
  EXPECT_EQ(system.unknown_count, 2u);
  EXPECT_EQ(system.dropped, 0u);
  const std::vector<double> u = system.expanded({8, 0});
  EXPECT_EQ(u, (std::vector<double>{8, 0, 2, 1, 1}));
}

TEST(UprightSystem, drops_a_constraint_that_would_go_round_in_a_circle) {
  const UprightSystem system = substitute(3, {{0, 1, 1, 1, 0}, {1, 2, 2, 1, 0}, {2, 0, 0, 1, 0}});
  EXPECT_EQ(system.dropped, 1u);
  EXPECT_EQ(system.unknown_count, 1u);
  EXPECT_EQ(system.expanded({5}), (std::vector<double>{5, 5, 5}));
}

TEST(UprightSystem, knows_the_gradients_of_linear_functions) {
  const LabelledTets tets = *label_tets(support::filled(*vertical_faults(0, false), 150));
  const std::vector<TetGradients> gradients = tet_gradients(tets);
  for (std::size_t t = 0; t < gradients.size(); ++t) {
    Vec3 of_x;
    for (std::size_t k = 0; k < 4; ++k) of_x = of_x + tets.points[tets.tets[t][k]].x * gradients[t].gradient[k];
    EXPECT_NEAR(length(of_x - Vec3{1, 0, 0}), 0, 1e-6);
    EXPECT_GT(gradients[t].volume_m3, 0);
  }
}

}  // namespace
}  // namespace strataflow
