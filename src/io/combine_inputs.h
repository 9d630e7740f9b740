#pragma once
#include <vector>

#include "model/input_data.h"

namespace strataflow {

/// One input out of several, in their order: points, triangles, patches, regions, cells follow one another. Entities
/// of the same name and role become one. All parts must share one local origin (readers leave it at zero).
InputData combine_inputs(std::vector<InputData> parts);

}  // namespace strataflow
