#pragma once
#include <vector>

#include "model/input_data.h"

namespace strataflow {

/// Surfaces of faults as a map shows them: the parts of their borders below which the surface falls away, within 60° of
/// straight down the dip. Identical points count as one. One line or more per entity, with its name and role, z kept;
/// entities in order, their lines by first point. A level surface has none.
std::vector<Polyline> traces_of_surfaces(const TriangleSoup& soup);

}  // namespace strataflow
