#pragma once
#include <map>
#include <string>

#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "model/input_data.h"
#include "stages/extract_quads_stage.h"
#include "stages/verticalize_stage.h"

namespace strataflow {

/// [hex]: where the plan has shorter edges.
struct RefinePlanOptions {
  std::map<std::string, double> refine_edge_m;
  std::map<std::string, double> refine_within_m;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(refine_edge_m,
          OptionField{.name = "refine_edge_m",
                      .description = "Shorter edges of the plan near wells, points, lines and faults and over regions, "
                                     "by name; quads are cut in three as often as comes nearest",
                      .minimum = 0,
                      .exclusive_minimum = true});
    visit(refine_within_m, OptionField{.name = "refine_within_m",
                                       .description = "How far from these, by name; one edge if not named, 0 for regions",
                                       .minimum = 0});
  }
};

/// A plan of quads with shorter edges where they are wanted (coudert2024 S10, S21).
struct RefinePlan {
  static constexpr std::string_view name = "refine_plan";
  static constexpr int version = 1;
  RefinePlanOptions options;

  Result<MeshedQuads> operator()(const MeshedQuads& plan, const UprightModel& upright, const InputData& input,
                                 StageContext& context) const;
};

}  // namespace strataflow
