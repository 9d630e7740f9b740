#pragma once
#include <string>
#include <vector>

#include "base/result.h"
#include "kernels/hexes/baselines/plan_frame.h"
#include "model/feature_mesh.h"

namespace strataflow {

/// A curve that one index is constant along: a side of the plan, or a connected piece of a fault's trace.
struct PillarLine {
  std::string name;
  std::uint32_t feature = no_index;   ///< no_index: a side
  bool is_along_j = true;             ///< I is constant; else J
  std::vector<std::uint32_t> points;  ///< of the plan problem, ascending
};

/// The sides low I, high I, low J and high J, then the faults by feature and first edge.
struct PillarLines {
  PlanFrame frame;
  std::vector<PillarLine> lines;
};

/// Decides which traces bound cells in I and which in J (coudert2024 S7): two that touch must differ, or the cells
/// between them would collapse, unless one goes straight on where the other ends; so must a trace and the side it ends
/// on. Where that leaves a choice, the direction decides. Traces are parted where they turn by more than 45°. Fails
/// with unsupported, by name: a hole, an outline without four sides, a fault that fits neither, a fault with a
/// thickness.
Result<PillarLines> assign_pillar_lines(const FeatureMesh& problem);

}  // namespace strataflow
