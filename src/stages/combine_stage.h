#pragma once
#include <vector>

#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "model/input_data.h"

namespace strataflow {

/// Puts the inputs of a job together, in their order, and moves them near the origin (exactly).
struct Combine {
  static constexpr std::string_view name = "combine";
  static constexpr int version = 2;
  NoOptions options;

  Result<InputData> operator()(const std::vector<const InputData*>& parts, StageContext&) const;
};

}  // namespace strataflow
