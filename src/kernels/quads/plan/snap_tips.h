#pragma once
#include "kernels/quads/plan/plan_curves.h"

namespace strataflow {

/// Leads the ends of curves onto what they nearly reach, fault tips first of all that is cleaned (peers.md §6): an end
/// that juts out past a curve by at most `limit_m` is cut off there, an end within `limit_m` of another end or of
/// a curve is moved onto it. Points within `limit_m` of a curve move onto it too. What is moved is listed.
void snap_tips(PlanCurves& plan, double limit_m);

}  // namespace strataflow
