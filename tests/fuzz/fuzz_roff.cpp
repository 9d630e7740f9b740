#include "io/simulator/read_roff.h"
#include "mesh_reader_contract.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return strataflow::check_mesh_reader(strataflow::read_roff, "fuzz.roff", data, size);
}
