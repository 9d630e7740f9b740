#include "stages/tetrahedralize_stage.h"

#include "stages/check_validity_stage.h"

namespace strataflow {

Result<VolumeMesh> Tetrahedralize::operator()(const BuiltModel& built, const ValidityReport& validity,
                                              StageContext& context) const {
  if (std::optional<Failure> failure = why_not_sealed(built.model, validity)) return *failure;
  Result<VolumeMesh> mesh = tetrahedralize_model(built.model, options, context.cancellation());
  if (mesh)
    for (const Change& change : mesh->changes) context.warn(change.kind, change.what + ": " + change.why);
  return mesh;
}

}  // namespace strataflow
