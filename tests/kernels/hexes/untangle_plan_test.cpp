#include "kernels/hexes/untangle_plan.h"

#include <gtest/gtest.h>

#include "kernels/hexes/tet_models.h"

namespace strataflow {
namespace {

/// Of Σ |t| ‖∇u‖² with the first unknown held.
Multigrid guide_of(const LabelledTets& tets, const UprightSystem& system,
                                      const std::vector<TetGradients>& gradients) {
  std::vector<MatrixEntry> lower{{0, 0, 1e3}};
  for (std::size_t t = 0; t < tets.tets.size(); ++t)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        const std::uint32_t row = system.first[tets.tets[t][i]], column = system.first[tets.tets[t][j]];
        if (row >= column)
          lower.push_back({row, column, gradients[t].volume_m3 * dot(gradients[t].gradient[i], gradients[t].gradient[j])});
      }
  return Multigrid(symmetric_rows(system.unknown_count, lower), constant_mode(system.unknown_count));
}

TEST(UntanglePlan, turns_back_what_was_turned_over) {
  const LabelledTets tets = *label_tets(support::filled(*vertical_faults(0, false), 150));
  const UprightSystem system = substitute(tets.points.size(), {});
  const std::vector<TetGradients> gradients = tet_gradients(tets);
  std::vector<double> u, v;
  for (const std::uint32_t p : system.point_of) {
    const Vec3& at = tets.points[p];
    const bool is_thrown = at.x > 500 && at.x < 900 && at.y > 400 && at.y < 800 && at.z > 100 && at.z < 300;
    u.push_back(at.x + (is_thrown ? 500 : 0));
    v.push_back(at.y - (is_thrown ? 300 : 0));
  }
  const UntangledPlan untangled =
      untangle_plan(tets, system, gradients, guide_of(tets, system, gradients), u, v, 300);
  EXPECT_TRUE(untangled.is_free_of_foldovers);
  EXPECT_GT(untangled.smallest_determinant, 0);
  EXPECT_GT(untangled.steps, 0u);
  const UntangledPlan stopped = untangle_plan(tets, system, gradients, guide_of(tets, system, gradients), u, v, 0);
  EXPECT_FALSE(stopped.is_free_of_foldovers);
  EXPECT_EQ(stopped.u, u);
}

}  // namespace
}  // namespace strataflow
