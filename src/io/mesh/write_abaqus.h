#pragma once
#include <string>

#include "io/input/labelled_triangles.h"

namespace strataflow {

/// Abaqus .inp, exact coordinates. A volume mesh: solid elements (C3D4, C3D5, C3D6, C3D8) with an element set and a
/// node set per region, and a node set per surface. Surfaces alone: shells (S3, S4) with an element and a node set per
/// surface.
std::string write_abaqus(const VolumeMesh& mesh);
std::string write_abaqus(const LabelledTriangles& surfaces);

}  // namespace strataflow
