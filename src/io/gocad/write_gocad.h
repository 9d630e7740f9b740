#pragma once
#include <string>

#include "base/result.h"
#include "model/structural_model.h"
#include "model/triangle_soup.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// The surfaces as GOCAD TSurf objects: one per entity, a TFACE per patch, vertex properties, border records.
/// Coordinates are the file's own again (`local_origin` added), in the shortest form that reads back bit for bit;
/// ZPOSITIVE Elevation. Entities without a name get one; equal names are told apart.
std::string write_gocad_ts(const TriangleSoup& surfaces);

/// The model as a GOCAD Model3d with its TSurf objects: a TFACE per surface, REGION records (Universe first), layers,
/// BSTONE and BORDER records of its corners and lines.
std::string write_gocad_ml(const StructuralModel& model, const std::string& name);

/// The mesh as a GOCAD TSolid: a TVOLUME per region, its facets as the TFACEs of its model part (a SURFACE per entity).
/// Fails with unsupported when a cell is not a tetrahedron: TSolid holds nothing else.
Result<std::string> write_gocad_so(const VolumeMesh& mesh, const std::string& name);

}  // namespace strataflow
