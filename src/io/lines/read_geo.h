#pragma once
#include <functional>
#include <string>
#include <string_view>

#include "base/result.h"
#include "model/input_data.h"

namespace strataflow {

/// The text of a file that another includes; its name is written relative to the folder of the first.
using IncludeReader = std::function<Result<std::string>(const std::string& name)>;

/// A section as Gmsh geometry (.geo): points, straight lines, plane surfaces made of them, physical groups, constants,
/// `If`, the bounding box of everything and `Dilate` of everything. The outer boundary becomes an outline, boundaries of
/// voids holes, other lines curves between junctions, called after the groups of surfaces on both sides
/// ("Facies 3 | Facies 5"). Mesh sizes are ignored. Fails with malformed_file, or unsupported for statements that would
/// change the geometry (arcs, splines, loops of the script, operations on solids) and for `Include`; both name file:line.
Result<InputData> read_geo(std::string_view bytes, const std::string& file_name);

/// The same with `Include`, up to 16 deep; fails as `read_include` does for a file that cannot be read.
Result<InputData> read_geo_including(std::string_view bytes, const std::string& file_name,
                                     const IncludeReader& read_include);

}  // namespace strataflow
