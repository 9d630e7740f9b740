#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "model/cut_result.h"
#include "model/input_data.h"
#include "stages/judge_surfaces_stage.h"

namespace strataflow {

struct CutConstrainedOptions {
  template <class Visitor>
  static void visit_angles(Visitor& visit, double& stone_angle_deg, double& facing_deg) {
    visit(stone_angle_deg, OptionField{.name = "stone_angle_deg",
                                       .description = "A border that turns by more than this has a corner there",
                                       .minimum = 0,
                                       .maximum = 180,
                                       .exclusive_minimum = true});
    visit(facing_deg,
          OptionField{.name = "facing_deg",
                      .description = "A border that goes on at less than this angle to a surface runs beside "
                                     "it and is not led onto it unasked",
                      .minimum = 0,
                      .maximum = 90});
  }

  std::vector<std::string> contacts;
  std::optional<double> distance_m;
  double stone_angle_deg = 40;
  double facing_deg = 5;
  std::optional<double> tolerance_m;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(contacts,
          OptionField{.name = "contacts",
                      .description = "Contacts to make, each \"H2 -> F3\" (the nearest border of H2 onto F3), "
                                     "\"H2 -> F3 within 25\" (every border within 25 m), \"H2.border 4 -> F3\" "
                                     "or \"H2.stone -> F3.border\" (the end of a slit onto a fault's tip)"});
    visit(distance_m,
          OptionField{.name = "distance_m",
                      .description = "Borders that stop this short of another surface, or overshoot "
                                     "it by no more, are led onto it; 0: only named contacts; "
                                     "absent: 1 % of the diagonal",
                      .minimum = 0});
    visit_angles(visit, stone_angle_deg, facing_deg);
    visit(tolerance_m, OptionField{.name = "tolerance_m",
                                   .description = "Closer to a vertex or edge of the other surface is on it; absent: a "
                                                  "millionth of the diagonal",
                                   .minimum = 0,
                                   .is_internal = true});
  }
};

/// Leads borders that stop short of a surface, or overshoot it, onto it, so that both share the contact vertex for
/// vertex (euler1999 §2.4); named contacts first. What was led how far is a change and a warning (`contact_made`), what
/// could not be a warning (`contact_failed`). Surfaces that need no sealing pass unchanged. Fails with invalid_options
/// for a contact that names nothing.
struct CutConstrained {
  static constexpr std::string_view name = "cut_constrained";
  static constexpr int version = 5;
  CutConstrainedOptions options;

  Result<CutResult> operator()(const InputData& input, const SealingNeed& need, StageContext& context) const;
};

}  // namespace strataflow
