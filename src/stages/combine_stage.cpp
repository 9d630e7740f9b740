#include "stages/combine_stage.h"

#include "io/combine_inputs.h"
#include "io/local_origin.h"

namespace strataflow {

Result<InputData> Combine::operator()(const std::vector<const InputData*>& parts, StageContext&) const {
  std::vector<InputData> copies;
  copies.reserve(parts.size());
  for (const InputData* part : parts) copies.push_back(*part);
  InputData whole = combine_inputs(std::move(copies));
  shift_to_local_origin(whole);
  return whole;
}

}  // namespace strataflow
