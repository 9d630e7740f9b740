#pragma once
#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "kernels/quality/analyze_volume_mesh.h"
#include "model/built_model.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// Measures a volume mesh and holds it against the model it fills, independently of how it was made. Fails with
/// geometry_failed when a cell is inverted, a face does not conform, or cells and facets do not add up to the regions
/// and surfaces of the model: an invalid mesh is never written.
struct CheckMesh {
  static constexpr std::string_view name = "check_mesh";
  static constexpr int version = 2;
  NoOptions options;

  Result<VolumeQualityReport> operator()(const BuiltModel& built, const VolumeMesh& mesh, StageContext&) const;
};

}  // namespace strataflow
