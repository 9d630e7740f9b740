#include "stages/stratigraphic_function_stage.h"

#include <cmath>

namespace strataflow {

Result<LayeredSpace> FindStratigraphicFunction::operator()(const UprightModel& upright, StageContext& context) const {
  LayerOptions layers;
  layers.layers = options.layers;
  layers.thickness_m = options.layer_thickness_m;
  for (const auto& [unit, count] : options.unit_layers) {
    if (count != std::floor(count))
      return Failure{FailureCode::invalid_options,
                     "hex.unit_layers gives unit " + unit + " " + std::to_string(count) + " layers",
                     "give it a whole number"};
    layers.unit_layers[unit] = static_cast<std::int64_t>(count);
  }
  layers.layout = options.layering == "parallel_to_top"    ? LayerLayout::parallel_to_top
                  : options.layering == "parallel_to_base" ? LayerLayout::parallel_to_base
                                                           : LayerLayout::proportional;
  for (const std::string& unit : options.parallel_to_top) layers.unit_layout[unit] = LayerLayout::parallel_to_top;
  for (const std::string& unit : options.parallel_to_base) layers.unit_layout[unit] = LayerLayout::parallel_to_base;
  Result<LayeredSpace> space = build_layered_space(UprightModel(upright), layers);
  if (space)
    for (const Change& change : space->changes) context.warn(change.kind, change.what + ": " + change.why);
  return space;
}

}  // namespace strataflow
