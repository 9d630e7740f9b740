#include "stages/complexity_stage.h"

namespace strataflow {

Result<ComplexityReport> MeasureComplexity::operator()(const BuiltModel& built, StageContext& context) const {
  Result<ComplexityReport> report = measure_complexity(built.model, options, context.seed());
  if (report && report->geometric.spacing_m > 0.5001 * report->geometric.edge_length_m)
    context.warn("coarse_thickness", "thickness was sampled every " +
                                         OptionPrinter::literal(report->geometric.spacing_m) +
                                         " m instead of edge_length_m / 2: the model is large for that edge length");
  return report;
}

}  // namespace strataflow
