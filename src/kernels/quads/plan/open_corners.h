#pragma once
#include "kernels/quads/plan/plan_graph.h"

namespace strataflow {

/// Opens corners sharper than `wanted_deg`, which bound how good a quad there can be: about an edge length from the
/// corner each of its sides is bent away from the other, as far as that angle needs and `limit_m` from the input
/// allows. The corner stays, no other curve is touched or crossed, and what is bent is listed. Sides with another
/// sharp corner behind them stay as they are; an outline is bent last.
void open_acute_corners(PlanGraph& graph, double limit_m, double wanted_deg);

}  // namespace strataflow
