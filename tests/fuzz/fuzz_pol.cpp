#include "io/lines/read_pol.h"
#include "mesh_reader_contract.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return strataflow::check_mesh_reader(strataflow::read_pol, "fuzz.pol", data, size);
}
