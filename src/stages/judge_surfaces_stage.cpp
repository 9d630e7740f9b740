#include "stages/judge_surfaces_stage.h"

#include <algorithm>

#include "kernels/sealing/find_leaks.h"
#include "kernels/sealing/seal_surfaces.h"
#include "kernels/topology/building/build_structural_model.h"
#include "kernels/topology/validity/check_validity.h"
#include "stages/check_validity_stage.h"
#include "stages/seal_stage.h"

namespace strataflow {

Result<SealingNeed> JudgeSurfaces::operator()(const InputData& input, StageContext&) const {
  if (options.mode != "auto") return SealingNeed{options.mode == "always", "asked for"};
  const Result<BuiltModel> built = build_structural_model(input.surfaces);
  if (!built) return built.failure();
  const ValidityReport report = check_validity(*built);
  if (why_not_sealed(built->model, report)) {
    for (const Violation& violation : report.violations)
      if (violation.severity == Violation::Severity::error && !violation.is_mended)
        return SealingNeed{true, violation.kind + ": " + violation.what};
    return SealingNeed{true, "the outer shell is open"};
  }
  // A closed box with loose surfaces in it is sealed too. A file that lists its regions means them; otherwise a surface
  // that touches nothing, but nearly reaches something all along a border, tells that the input is not a model yet.
  if (!input.surfaces.regions.empty()) return SealingNeed{};
  const std::vector<std::uint32_t> loose = find_loose_entities(input.surfaces);
  if (loose.empty()) return SealingNeed{};
  const double distance = sealing_distance_m(input.surfaces, {});
  for (const Leak& leak : find_leaks(input.surfaces, distance, SealStageOptions{}.leak_search_ratio * distance))
    if (std::binary_search(loose.begin(), loose.end(), leak.entity)) return SealingNeed{true, "leak: " + leak.text};
  return SealingNeed{};
}

}  // namespace strataflow
