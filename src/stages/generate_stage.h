#pragma once
#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "model/input_data.h"

namespace strataflow {

struct GenerateOptions {
  std::string model = "A1";
  std::optional<double> resolution_m;
  std::optional<double> raw_ratio;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(model, OptionField{.name = "model", .description = "Name of the reference model"});
    visit(resolution_m, OptionField{.name = "resolution_m",
                                    .description = "Length of the triangles' edges; absent: about 10 000 triangles",
                                    .minimum = 0,
                                    .exclusive_minimum = true});
    visit(raw_ratio, OptionField{.name = "raw_ratio",
                                 .description = "Surfaces stop short by this share of their extent, or overshoot if "
                                                "negative; absent: sealed",
                                 .minimum = -0.2,
                                 .maximum = 0.2});
  }
};

/// Makes a reference model (pellerin2014 §4.2) instead of reading one.
struct Generate {
  static constexpr std::string_view name = "generate";
  static constexpr int version = 2;
  GenerateOptions options;

  Result<InputData> operator()(StageContext&) const;
};

}  // namespace strataflow
