#include "stages/volume_frames_stage.h"

#include <string>

#include "kernels/quads/field/volume_frames.h"

namespace strataflow {

Result<FramedMesh> FindVolumeFrames::operator()(const VolumeMesh& mesh, StageContext& context) const {
  VolumeFrameOptions wanted;
  wanted.lambda = options.orthogonality;
  wanted.iterations = options.iterations;
  wanted.is_cancelled = [&] { return context.is_cancelled(); };
  Result<VolumeFrames> found = compute_volume_frames(mesh, wanted);
  if (!found) return found.failure();
  if (context.is_cancelled())
    return Failure{FailureCode::cancelled, "cancelled", "run it again: finished stages are taken from the store"};
  FramedMesh framed{mesh, {}, std::move(found->singular), found->energy, found->iterations, found->smallest_determinant};
  for (std::size_t i = 0; i < 3; ++i) {
    CellField& field = framed.directions.emplace_back(CellField{"direction_" + std::to_string(i), {}});
    for (const VolumeFrame& frame : found->frames)
      field.values.insert(field.values.end(), {frame[i].x, frame[i].y, frame[i].z});
  }
  return framed;
}

}  // namespace strataflow
