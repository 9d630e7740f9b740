#include "stages/generate_stage.h"

#include "kernels/reference_models/generate_reference_model.h"

namespace strataflow {

Result<InputData> Generate::operator()(StageContext&) const {
  Result<TriangleSoup> surfaces = generate_reference_model(options.model, {options.resolution_m, options.raw_ratio});
  if (!surfaces) return surfaces.failure();
  InputData data;
  data.surfaces = *std::move(surfaces);
  return data;
}

}  // namespace strataflow
