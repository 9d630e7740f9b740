#include "stages/check_mesh_stage.h"

#include "kernels/quality/check_mesh_against_model.h"

namespace strataflow {

Result<VolumeQualityReport> CheckMesh::operator()(const BuiltModel& built, const VolumeMesh& mesh,
                                                  StageContext&) const {
  VolumeQualityReport quality = analyze_volume_mesh(mesh);
  std::string defects;
  const auto count = [&](std::uint64_t number, const std::string& what) {
    if (number > 0) defects += "\n  " + std::to_string(number) + " " + what;
  };
  count(quality.inverted, "inverted cells");
  count(quality.nonconforming_faces, "faces that do not conform");
  count(quality.open_boundary_edges, "open edges on the boundary");
  for (const Violation& violation : check_mesh_against_model(mesh, built.model))
    defects += "\n  " + violation.kind + ": " + violation.what;
  if (defects.empty()) return quality;
  return Failure{FailureCode::geometry_failed, "the mesh is not valid:" + defects,
                 "nothing was written; try other [tetrahedralize] options, and report this"};
}

}  // namespace strataflow
