#pragma once
#include "kernels/volumes/fill_regions.h"
#include "model/structural_model.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// Puts the regions side by side in one mesh: the points of the surfaces, then the interior points and the cells region
/// by region, then the triangles of the surfaces as facets between them. Surfaces outside every region are left out
/// and listed in the changes. Fails with unsupported for more points or cells than 32-bit indices number.
Result<VolumeMesh> merged_regions(const StructuralModel& model, FilledRegions filled);

}  // namespace strataflow
