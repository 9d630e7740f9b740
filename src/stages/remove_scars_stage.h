#pragma once
#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "model/input_data.h"

namespace strataflow {

struct RemoveScarsStageOptions {
  bool remove_scars = false;
  bool keep_original_nodes = true;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(remove_scars, OptionField{.name = "remove_scars",
                                    .description = "Sew the slits that an earlier cut left in the surfaces and erase "
                                                   "their nodes before cutting"});
    visit(keep_original_nodes, OptionField{.name = "keep_original_nodes",
                                           .description = "Erase only nodes that the point property inserted_by_cut "
                                                          "marks, where it is given"});
  }
};

/// Undoes earlier cuts (euler1999 §2.5). A point property `inserted_by_cut` (1 or 0) tells the nodes of a cut from
/// those of the surface; it is used up.
struct RemoveScars {
  static constexpr std::string_view name = "remove_scars";
  static constexpr int version = 2;
  RemoveScarsStageOptions options;

  Result<InputData> operator()(const InputData& input, StageContext& context) const;
};

}  // namespace strataflow
