#pragma once
#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "model/built_model.h"
#include "model/input_data.h"

namespace strataflow {

/// Builds the structural model of the input's surfaces: corners, lines, surfaces, regions (pellerin2014 §2.1). What was
/// wrong with the input is in the output; what building mended (dropped triangles, rebuilt borders) is also a warning.
struct BuildModel {
  static constexpr std::string_view name = "build_model";
  static constexpr int version = 3;
  NoOptions options;

  Result<BuiltModel> operator()(const InputData& input, StageContext& context) const;
};

}  // namespace strataflow
