#pragma once
#include "model/structural_model.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// A model as a file of it would hold it, but for points and triangles: a patch per surface with its entities, the
/// regions with the sides around them, the layers. For surfaces that were made from the model's, one patch each.
TriangleSoup patches_of_model(const StructuralModel& model);

/// The same with the model's points, triangles and properties. Keeps the model's local origin.
TriangleSoup soup_of_model(const StructuralModel& model);

}  // namespace strataflow
