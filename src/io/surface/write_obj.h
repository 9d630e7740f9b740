#pragma once
#include <string>

#include "io/input/labelled_triangles.h"

namespace strataflow {

/// Wavefront OBJ: an object (`o`) per entity, a group (`g`) per surface, points shared. Exact coordinates.
std::string write_obj(const LabelledTriangles& surfaces);

}  // namespace strataflow
