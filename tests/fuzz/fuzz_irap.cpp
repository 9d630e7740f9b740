#include "io/surface/read_irap.h"
#include "mesh_reader_contract.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return strataflow::check_mesh_reader(strataflow::read_irap, "fuzz.gri", data, size);
}
