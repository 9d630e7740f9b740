#pragma once
#include <span>
#include <vector>

#include "model/structural_model.h"

namespace strataflow {

/// The point properties of a model at other points: linear on the nearest triangle, of which corners without data (NaN)
/// are left out; NaN where none has data.
std::vector<PointProperty> interpolate_properties(const StructuralModel& model, std::span<const Vec3> points);

}  // namespace strataflow
