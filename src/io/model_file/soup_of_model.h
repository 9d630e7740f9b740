#pragma once
#include "model/structural_model.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// The triangles of a model as a file of it would hold them: a patch per surface (and one more for every further entity
/// of a coincident surface), the regions with the sides around them, the layers. Keeps the model's local origin.
TriangleSoup soup_of_model(const StructuralModel& model);

}  // namespace strataflow
