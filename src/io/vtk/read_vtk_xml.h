#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "model/input_data.h"

namespace strataflow {

/// Reads VTK XML PolyData (.vtp) and UnstructuredGrid (.vtu): ascii, inline base64, appended raw or base64, zlib or
/// not, either byte order, any header and number type, several pieces.
///
/// Cell arrays `surface` and `entity` make patches, `region` the region of volume cells; field data `entity_names`,
/// `entity_roles`, `region_names` name them (VTK strings, or UTF-8 bytes each ended by a zero). Point arrays of numbers
/// become properties. Everything else is named by a warning.
/// Fails with: malformed_file, unsupported (another data set type or compressor).
Result<InputData> read_vtk_xml(std::string_view bytes, const std::string& file_name);

}  // namespace strataflow
