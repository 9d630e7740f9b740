#pragma once
#include <vector>

#include "kernels/topology/building/edge_table.h"
#include "model/structural_model.h"
#include "model/validity_report.h"

namespace strataflow {

/// Fills `model.frontiers` and `model.regions` and the regions on both sides of every surface from triangles,
/// surfaces and lines (euler1999 §2.2.2–2.2.4): sides of surfaces are linked through the radial order around feature
/// edges, linked sides form frontiers, frontiers with positive volume are regions, the others are cavities of the
/// innermost region around them, or border the universe. Where the order around a line is unknown or changes, the
/// volumes of the regions it may concern are NaN. Returns what it found odd.
std::vector<Violation> build_regions(StructuralModel& model, const EdgeTable& edges,
                                     const std::vector<std::vector<std::uint32_t>>& line_edges);

}  // namespace strataflow
