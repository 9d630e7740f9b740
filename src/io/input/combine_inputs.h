#pragma once
#include <vector>

#include "base/result.h"
#include "model/input_data.h"

namespace strataflow {

/// One input out of several, in their order: points, triangles, patches, regions, cells follow one another. Entities
/// of the same name and role become one. All parts must share one local origin (readers leave it at zero). Fails with
/// unsupported for more than 32-bit indices number.
Result<InputData> combine_inputs(std::vector<InputData> parts);

}  // namespace strataflow
