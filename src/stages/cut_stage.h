#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "model/cut_result.h"
#include "stages/judge_surfaces_stage.h"

namespace strataflow {

struct CutStageOptions {
  std::vector<std::string> cut;
  std::vector<std::string> cutting;
  double tolerance_m = 0;
  double intersection_tolerance_ratio = 1e-9;
  bool mark_inserted = false;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(cut, OptionField{.name = "cut", .description = "Surfaces that are cut, by name; empty: all"});
    visit(cutting, OptionField{.name = "cutting", .description = "Surfaces that cut them, by name; empty: all"});
    visit(tolerance_m, OptionField{.name = "tolerance_m",
                                   .description = "Input points closer than this become one before cutting: the "
                                                  "precision the input was stored with; 0: only equal ones",
                                   .minimum = 0});
    visit(intersection_tolerance_ratio,
          OptionField{.name = "intersection_tolerance_ratio",
                      .description = "Points of intersection closer than this share of the diagonal to an input point, "
                                     "or to each other, become one",
                      .minimum = 0,
                      .maximum = 1e-3});
    visit(mark_inserted, OptionField{.name = "mark_inserted",
                                     .description = "Give the points that cutting makes the value 1 of a point "
                                                    "property inserted_by_cut, all others 0: remove_scars can then "
                                                    "undo this cut"});
  }
};

/// Cuts surfaces along everything they share, exactly (euler1999 §2.3, §2.6), once contacts are made, whose changes it
/// hands on. Surfaces that need no cutting pass unchanged.
struct Cut {
  static constexpr std::string_view name = "cut";
  static constexpr int version = 2;
  CutStageOptions options;

  Result<CutResult> operator()(const CutResult& joined, const SealingNeed& need, StageContext& context) const;
};

}  // namespace strataflow
