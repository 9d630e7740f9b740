#pragma once
#include <string>

#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "model/input_data.h"

namespace strataflow {

/// Whether surfaces must be cut and sealed, and why.
struct SealingNeed {
  bool is_needed = false;
  std::string reason;  ///< the first violation in the way, or "asked for"
  template <class A>
  void archive(A& a) {
    a(is_needed, reason);
  }
};

struct JudgeSurfacesOptions {
  std::string mode = "auto";
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(mode, OptionField{.name = "mode",
                            .description = "Make contacts, cut and seal: auto if surfaces cross or leak; never: take "
                                           "them as they are, to describe them; always",
                            .words = {"auto", "never", "always"}});
  }
};

/// Builds the model of the surfaces as they are and decides whether they need cutting and sealing.
struct JudgeSurfaces {
  static constexpr std::string_view name = "judge_surfaces";
  static constexpr int version = 1;
  JudgeSurfacesOptions options;

  Result<SealingNeed> operator()(const InputData& input, StageContext& context) const;
};

}  // namespace strataflow
