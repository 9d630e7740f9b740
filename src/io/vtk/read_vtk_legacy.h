#pragma once
#include <string>
#include <string_view>

#include "base/result.h"
#include "model/input_data.h"

namespace strataflow {

/// Reads legacy VTK, ascii or binary, POLYDATA and UNSTRUCTURED_GRID, files of version 1 to 5.1. Cell arrays `surface`,
/// `entity`, `region` and point arrays as in read_vtk_xml. Fails with: malformed_file, unsupported (other data sets).
Result<InputData> read_vtk_legacy(std::string_view bytes, const std::string& file_name);

}  // namespace strataflow
