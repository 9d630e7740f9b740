#include "stages/combine_stage.h"

#include "io/input/combine_inputs.h"
#include "io/input/local_origin.h"

namespace strataflow {

Result<InputData> Combine::operator()(const std::vector<const InputData*>& parts, StageContext&) const {
  std::vector<InputData> copies;
  copies.reserve(parts.size());
  for (const InputData* part : parts) copies.push_back(*part);
  Result<InputData> whole = combine_inputs(std::move(copies));
  if (whole) shift_to_local_origin(*whole);
  return whole;
}

}  // namespace strataflow
