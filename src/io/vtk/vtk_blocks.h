#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"

namespace strataflow {

/// How the arrays of one VTK XML file are packed.
struct VtkPacking {
  bool is_compressed = false;       ///< zlib, in blocks
  bool has_64_bit_headers = false;  ///< header_type UInt64
  bool is_big_endian = false;
};

/// The bytes of one binary array. `encoded` starts at the array's header and may go on behind its end.
/// Every size is compared with what is there before memory is taken (zlib cannot inflate more than 1032:1).
/// Fails with malformed_file; `name` is put in front of the message.
Result<std::string> unpack_vtk_array(std::string_view encoded, bool is_base64, const VtkPacking& packing,
                                     const std::string& name);

/// Packs an array: UInt64 header, zlib blocks of 1 MB at a fixed level.
std::string pack_vtk_array(std::string_view bytes);

}  // namespace strataflow
