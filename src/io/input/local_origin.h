#pragma once
#include "model/input_data.h"

namespace strataflow {

/// Moves all coordinates near the origin and notes the shift in `local_origin`. Per axis the shift is chosen so that
/// every subtraction is exact (checked point by point), hence `point + local_origin` gives back the very same
/// doubles; an axis on which no useful shift is exact stays as it is. Data that has a local origin is left alone.
void shift_to_local_origin(InputData& data);

}  // namespace strataflow
