#include "stages/check_validity_stage.h"

#include "kernels/topology/validity/check_validity.h"

namespace strataflow {

std::optional<Failure> why_not_sealed(const StructuralModel& model, const ValidityReport& report) {
  constexpr std::size_t most_reasons = 20;  // raw surfaces have hundreds; `check` lists them all
  std::string reasons;
  std::size_t count = 0;
  for (const Violation& violation : report.violations)
    if (violation.severity == Violation::Severity::error && !violation.is_mended && ++count <= most_reasons)
      reasons += "\n  " + violation.kind + ": " + violation.what;
  if (count > most_reasons) reasons += "\n  and " + std::to_string(count - most_reasons) + " more";
  if (reasons.empty() && is_sealed(model, report)) return std::nullopt;
  return Failure{
      FailureCode::invalid_input, "the model is not sealed" + (reasons.empty() ? "" : ":" + reasons),
      "`strataflow check` lists every violation; with cut.mode = \"auto\" or \"always\" surfaces are cut and sealed, "
      "gaps up to seal.distance_m closed"};
}

Result<ValidityReport> CheckValidity::operator()(const BuiltModel& built, StageContext& context) const {
  ValidityReport report = check_validity(built);
  if (options.must_be_sealed)
    if (std::optional<Failure> failure = why_not_sealed(built.model, report)) return *failure;
  for (const Violation& violation : report.violations)
    if (!violation.is_mended) context.warn(violation.kind, violation.what);
  return report;
}

}  // namespace strataflow
