#pragma once
#include "base/result.h"
#include "graph/stage_context.h"
#include "kernels/volumes/tetrahedralize_model.h"
#include "model/built_model.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// Fills every region of a sealed model with tetrahedra that conform to all surfaces. The validity report says that the
/// model is sealed; what happened to difficult regions is in the mesh's changes.
struct Tetrahedralize {
  static constexpr std::string_view name = "tetrahedralize";
  static constexpr int version = 2;
  TetrahedralizeOptions options;

  Result<VolumeMesh> operator()(const BuiltModel& built, const ValidityReport& validity, StageContext& context) const;
};

}  // namespace strataflow
