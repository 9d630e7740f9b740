#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "model/input_data.h"

namespace strataflow {

/// A section as Gmsh geometry (.geo): points, straight lines, plane surfaces made of them, physical groups, constants
/// and `If`. The outer boundary becomes an outline, boundaries of voids holes, other lines curves between junctions,
/// called after the groups of surfaces on both sides ("Facies 3 | Facies 5"). Mesh sizes are ignored. Fails with
/// malformed_file, or unsupported for statements that would change the geometry (arcs, splines, loops of the script,
/// operations on solids); both name file:line.
Result<InputData> read_geo(std::string_view bytes, const std::string& file_name);

}  // namespace strataflow
