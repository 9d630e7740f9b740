#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "model/input_data.h"

namespace strataflow {

/// Reads the objects of a GOCAD ascii file: Model3d, TSurf, PLine, VSet, Well, TSolid and LightTSolid, any number
/// of them, also inside groups. What is not read (SGrid, Voxet, properties of lines and volumes) is named by a warning.
///
/// - An entity per TSurf name, a patch per TFACE. The TFACE table of a Model3d numbers the patches; the k-th TFACE of
///   the TSurf named X is the k-th row named X, whatever the order of the TSurf objects.
/// - `ZPOSITIVE Depth` becomes z up: z changes sign, the order of vertices stays. GOCAD orders the vertices for z up
/// and
///   negates only the numbers: this way the + side of a REGION record is the side that normals point to, in files of
///   either kind.
/// - Tetrahedra have VTK's orientation when most of the file's do after one common choice of order; those that then
///   differ from the majority stay inverted, as the file has them.
/// - Atoms share the point of their vertex, except those with properties and those of a TSurf, which get a point of
///   their own at the same position: border records tell copies apart.
///
/// Fails with: malformed_file (file:line; truncated, no object, duplicate or unknown vertex, a number that is not
/// finite), unsupported (only objects that are not read).
Result<InputData> read_gocad(std::string_view text, const std::string& file_name);

}  // namespace strataflow
