#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "model/input_data.h"

namespace strataflow {

/// A horizon of the IRAP classic format (.gri), binary (big-endian Fortran records) or text: a grid of depths, turned
/// by an angle, two triangles a cell and one where a corner is undefined. The format does not say whether its numbers
/// count upwards: they are taken for depths, z = −depth, with a warning, unless none is positive. The surface has the
/// file's name. Fails with malformed_file naming the file and the place.
Result<InputData> read_irap(std::string_view bytes, const std::string& file_name);

}  // namespace strataflow
