#include "stages/frame_field_stage.h"

namespace strataflow {

Result<Attempt<FrameFieldResult>> ComputeFrameField::operator()(const FeatureMesh& mesh, StageContext&) const {
  return attempted(compute_frame_field(mesh, options.field), options.fallback);
}

}  // namespace strataflow
