#include "io/simulator/read_grdecl.h"
#include "mesh_reader_contract.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return strataflow::check_mesh_reader(strataflow::read_grdecl, "fuzz.grdecl", data, size);
}
