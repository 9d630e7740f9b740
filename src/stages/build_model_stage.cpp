#include "stages/build_model_stage.h"

#include "kernels/topology/building/build_structural_model.h"

namespace strataflow {

Result<BuiltModel> BuildModel::operator()(const InputData& input, StageContext& context) const {
  Result<BuiltModel> built = build_structural_model(input.surfaces);
  if (built)
    for (const Violation& violation : built->violations)
      if (violation.is_mended) context.warn(violation.kind, violation.what + "; mended by building anew");
  return built;
}

}  // namespace strataflow
