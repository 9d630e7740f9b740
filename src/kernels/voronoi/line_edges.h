#pragma once
#include <vector>

#include "kernels/voronoi/cvt_energy.h"
#include "model/structural_model.h"

namespace strataflow {

/// The edges of all lines of a model, each once, through the first triangle that has it; in the order of triangles.
std::vector<LineEdge> line_edges(const StructuralModel& model);

}  // namespace strataflow
