#pragma once
#include <gtest/gtest.h>

#include "kernels/quads/plan/plan_mesh.h"

namespace strataflow::support {

/// The plan problem of a rectangle 1000 × 800 m and traces of faults F1, F2, …
inline FeatureMesh plan_problem(const std::vector<std::vector<Vec3>>& traces, double edge_m = 100,
                                std::vector<Vec3> outline = {{0, 0, 0}, {1000, 0, 0}, {1000, 800, 0}, {0, 800, 0}}) {
  std::vector<Polyline> lines{{"outline", Role::outline, std::move(outline), true}};
  for (std::size_t f = 0; f < traces.size(); ++f)
    lines.push_back({"F" + std::to_string(f + 1), Role::fault, traces[f], false});
  PlanOptions options;
  options.edge_length_m = edge_m;
  Result<FeatureMesh> problem = plan_mesh(lines, {}, {}, options);
  EXPECT_TRUE(problem) << describe(problem.failure());
  return problem ? std::move(*problem) : FeatureMesh{};
}

}  // namespace strataflow::support
