#pragma once
#include "kernels/reference_models/column_model.h"

namespace strataflow {

/// The sealed, conforming surfaces of `model` with edges of about `edge_m`: one patch per entity. Conforming by
/// construction: there is one point per (map point, height), surfaces share points and not positions, levels over one
/// map triangle keep their order, and lines where a cutter truncates a level are nodes of both.
TriangleSoup seal_columns(const ColumnModel& model, double edge_m);

}  // namespace strataflow
