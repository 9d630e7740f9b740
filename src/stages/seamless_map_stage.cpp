#include "stages/seamless_map_stage.h"

#include <algorithm>

#include "kernels/quads/map/loosen_features.h"

namespace strataflow {

Result<Attempt<FieldAndMap>> SeamlessMap::operator()(const FeatureMesh& mesh, const Attempt<FrameFieldResult>& field,
                                                     StageContext& context) const {
  if (!field.why_not.empty()) return Attempt<FieldAndMap>{{}, field.why_not};
  FoldoverFreeOptions foldover_free;
  foldover_free.is_cancelled = [&] { return context.is_cancelled(); };
  const auto asked = loose_features(mesh, options.curves);
  if (!asked) return asked.failure();
  std::vector<std::uint32_t> loose = *asked;
  FeatureMesh followed = without_features(mesh, loose);
  std::vector<std::uint32_t> stuck;
  Result<OptimisedMap> map = optimise_map(followed, field.value.field, {}, nullptr, foldover_free, &stuck);
  if (map) return Attempt<FieldAndMap>{{field.value, *std::move(map), {}, loose}, {}};
  if (map.failure().code == FailureCode::cancelled) return map.failure();
  Result<FieldAndMap> other = compute_seamless_map(followed, options.field, foldover_free, nullptr, 1);
  if (other) context.warn("other_field", "another field had to be taken: with the first, " + map.failure().what);
  std::string why = map.failure().what;
  while (!other && options.curves.imprint && !context.is_cancelled()) {
    const auto feature = loosest_feature(followed, stuck);
    if (!feature) break;
    context.warn("loose_curve", "no map follows '" + mesh.features[*feature].name + "': " + why);
    loose.insert(std::lower_bound(loose.begin(), loose.end(), *feature), *feature);
    followed = without_features(mesh, loose);
    stuck.clear();
    other = compute_seamless_map(followed, options.field, foldover_free, &stuck);
    if (!other) why = other.failure().what;
  }
  if (!other) return attempted(Result<FieldAndMap>(map.failure()), options.fallback);
  other->loose = loose;
  return attempted(std::move(other), options.fallback);
}

}  // namespace strataflow
