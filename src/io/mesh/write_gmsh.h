#pragma once
#include <string>

#include "io/input/labelled_triangles.h"

namespace strataflow {

/// Gmsh 4.1, ascii, exact coordinates: an elementary surface per surface in the physical group of its entity, an
/// elementary and a physical volume per region. Elements are grouped by surface, then by region.
std::string write_gmsh(const VolumeMesh& mesh);
std::string write_gmsh(const LabelledTriangles& surfaces);

}  // namespace strataflow
