#pragma once
#include "base/result.h"
#include "kernels/sealing/trim_overshoot.h"

namespace strataflow {

/// Takes away surfaces that lie outside the boundary: whatever can be reached from outside without crossing a
/// boundary surface (entities whose role is boundary), where the boundary encloses a region. Without such a boundary
/// nothing changes.
Result<TrimmedSurfaces> trim_outside(const TriangleSoup& soup);

}  // namespace strataflow
