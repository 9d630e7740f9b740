#include "kernels/quads/map/seamless_map.h"

namespace strataflow {

std::vector<FrameFieldOptions> alternative_fields(const FrameFieldOptions& asked) {
  std::vector<FrameFieldOptions> fields(5, asked);
  fields[1].cancel_cost = 4 * asked.cancel_cost + 10;
  fields[2].cancel_cost = 0;
  fields[3].diffusions = asked.diffusions > 0 ? 0 : 4;
  fields[4].kind = asked.kind == "polynomial" ? "fast" : "polynomial";
  return fields;
}

Result<FieldAndMap> compute_seamless_map(const FeatureMesh& mesh, const FrameFieldOptions& field_options,
                                         const FoldoverFreeOptions& map_options, std::vector<std::uint32_t>* stuck,
                                         std::size_t first) {
  FieldAndMap result;
  std::vector<Failure> failures;
  const std::vector<FrameFieldOptions> fields = alternative_fields(field_options);
  for (std::size_t k = first; k < fields.size(); ++k) {
    Result<FrameFieldResult> field = compute_frame_field(mesh, fields[k]);
    if (!field && field.failure().code == FailureCode::invalid_input) return field.failure();
    if (field) {
      Result<OptimisedMap> map =
          optimise_map(mesh, field->field, {}, nullptr, map_options, failures.empty() ? stuck : nullptr);
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
  return failures.empty() ? Failure{FailureCode::invalid_options, "no such field", "begin with an earlier one"}
                          : failures.front();
}

}  // namespace strataflow
