#pragma once
#include <string>

#include "io/input/labelled_triangles.h"

namespace strataflow {

/// MEDIT .mesh, ascii, exact coordinates. References: surface + 1 of triangles and quadrilaterals, region + 1 of
/// volume cells (0: none). Corners of the model are listed as Corners.
std::string write_medit(const VolumeMesh& mesh);
std::string write_medit(const LabelledTriangles& surfaces);

}  // namespace strataflow
