#pragma once
#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "model/cut_result.h"
#include "model/input_data.h"

namespace strataflow {

struct SimplifyBordersStageOptions {
  bool borders = false;
  std::int64_t passes = 3;
  double corner_angle_deg = 45.0;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(borders, OptionField{.name = "borders",
                               .description = "Give contacts between surfaces the coarsest common sampling and relax "
                                              "the triangles beside them"});
    visit(passes, OptionField{.name = "passes", .description = "Repeat at most so often", .minimum = 1});
    visit(corner_angle_deg, OptionField{.name = "corner_angle_deg",
                                        .description = "Nodes where a contact turns by more stay where they are",
                                        .minimum = 0,
                                        .maximum = 180,
                                        .exclusive_minimum = true});
  }
};

/// Coarsens the contacts of conforming surfaces (euler1999 §2.9).
struct SimplifyBorders {
  static constexpr std::string_view name = "simplify_borders";
  static constexpr int version = 2;
  SimplifyBordersStageOptions options;

  Result<InputData> operator()(const CutResult& sealed, StageContext& context) const;
};

}  // namespace strataflow
