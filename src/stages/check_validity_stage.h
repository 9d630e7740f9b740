#pragma once
#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "model/built_model.h"

namespace strataflow {

struct CheckValidityOptions {
  bool must_be_sealed = true;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(must_be_sealed, OptionField{.name = "must_be_sealed",
                                      .description = "Fail on a model that leaks or whose surfaces cross; true unless "
                                                     "cut.mode is never and no product needs volumes",
                                      .is_internal = true});
  }
};

/// Judges a model by the rules for a static one (euler1999 §3, pellerin2014 §3).
struct CheckValidity {
  static constexpr std::string_view name = "check_validity";
  static constexpr int version = 3;
  CheckValidityOptions options;

  Result<ValidityReport> operator()(const BuiltModel& built, StageContext& context) const;
};

/// Why a model cannot be filled with cells, naming the violations in the way; nothing when it can.
std::optional<Failure> why_not_sealed(const StructuralModel& model, const ValidityReport& report);

}  // namespace strataflow
