#include "kernels/quads/map/seamless_map.h"

namespace strataflow {

Result<FieldAndMap> compute_seamless_map(const FeatureMesh& mesh, const FrameFieldOptions& field_options,
                                         const FoldoverFreeOptions& map_options) {
  std::vector<FrameFieldOptions> attempts(5, field_options);
  attempts[1].cancel_cost = 4 * field_options.cancel_cost + 10;
  attempts[2].cancel_cost = 0;
  attempts[3].diffusions = field_options.diffusions > 0 ? 0 : 4;
  attempts[4].kind = field_options.kind == "polynomial" ? "fast" : "polynomial";
  FieldAndMap result;
  std::vector<Failure> failures;
  for (const FrameFieldOptions& options : attempts) {
    Result<FrameFieldResult> field = compute_frame_field(mesh, options);
    if (!field && field.failure().code == FailureCode::invalid_input) return field.failure();
    if (field) {
      Result<OptimisedMap> map = optimise_map(mesh, field->field, {}, nullptr, map_options);
      if (map) {
        result.field = std::move(*field);
        result.map = std::move(*map);
        for (const Failure& failure : failures) result.retries.push_back(failure.what);
        return result;
      }
      failures.push_back(map.failure());
    } else {
      failures.push_back(field.failure());
    }
    if (map_options.is_cancelled && map_options.is_cancelled()) break;
  }
  return failures.front();
}

}  // namespace strataflow
