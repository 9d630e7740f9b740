#pragma once
#include <vector>

#include "model/structural_model.h"
#include "model/validity_report.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// Compares a volume mesh with the model it was made from, whose regions and surfaces it numbers alike:
/// - `region_volume_mismatch`: the cells of a region do not add up to the volume inside its surfaces (1e-9 relative);
/// - `cell_without_region`: cells that name no region of the model;
/// - `surface_not_covered`: the facets on a surface do not add up to its area (1e-9 relative);
/// - `facet_mismatch`: a facet is no face of the cells it names, or these are not in the regions beside its surface;
/// - `boundary_mismatch`: the faces with one cell do not add up to the area of the outer shell (cracks inside).
/// Returns nothing when all is well. Needs indices in range and the model's local origin in the mesh.
std::vector<Violation> check_mesh_against_model(const VolumeMesh& mesh, const StructuralModel& model);

}  // namespace strataflow
