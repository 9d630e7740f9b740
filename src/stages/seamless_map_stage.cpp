#include "stages/seamless_map_stage.h"

namespace strataflow {

Result<Attempt<FieldAndMap>> SeamlessMap::operator()(const FeatureMesh& mesh, const Attempt<FrameFieldResult>& field,
                                                     StageContext& context) const {
  if (!field.why_not.empty()) return Attempt<FieldAndMap>{{}, field.why_not};
  FoldoverFreeOptions foldover_free;
  foldover_free.is_cancelled = [&] { return context.is_cancelled(); };
  Result<OptimisedMap> map = optimise_map(mesh, field.value.field, {}, nullptr, foldover_free);
  if (map) return Attempt<FieldAndMap>{{field.value, *std::move(map), {}}, {}};
  if (map.failure().code == FailureCode::cancelled) return map.failure();
  Result<FieldAndMap> other = compute_seamless_map(mesh, options.field, foldover_free);
  if (other)
    context.warn("other_field", "another field had to be taken: with the first, " + map.failure().what);
  return attempted(std::move(other), options.fallback);
}

}  // namespace strataflow
