#pragma once
#include "base/result.h"
#include "kernels/quads/plan/plan_graph.h"

namespace strataflow {

/// Faults with a thickness become strips (coudert2024 S20): the cleaned trace is doubled, half the thickness to each
/// side, closed by a short segment where it dies and led up to the curve where it ends on one; curves that end on
/// the trace end on its side. The features "… left" and "… right" ask for `strip_quads` rows between them. All other
/// curves come back as they are. Fails with invalid_options for a name that is no fault here, or a thickness below
/// a twentieth of an edge.
Result<PlanCurves> widen_faults(PlanGraph graph, const PlanOptions& options);

}  // namespace strataflow
