#pragma once
#include "base/result.h"
#include "graph/stage_context.h"
#include "kernels/complexity/measure_complexity.h"
#include "model/built_model.h"

namespace strataflow {

/// Measures how complex a model is, as a whole and neighbourhood by neighbourhood (pellerin2014 chapter 3).
struct MeasureComplexity {
  static constexpr std::string_view name = "complexity";
  static constexpr int version = 1;
  static constexpr bool uses_seed = true;  // the sites of Voronoi cells start at random
  ComplexityOptions options;

  Result<ComplexityReport> operator()(const BuiltModel& built, StageContext& context) const;
};

}  // namespace strataflow
