#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "kernels/hexes/layered_space.h"

namespace strataflow {

/// [hex]: the layers.
struct LayerStageOptions {
  std::int64_t layers = 4;
  std::map<std::string, double> unit_layers{};
  std::optional<double> layer_thickness_m{};
  std::string layering = "proportional";
  std::vector<std::string> parallel_to_top{};
  std::vector<std::string> parallel_to_base{};
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(layers, OptionField{.name = "layers",
                              .description = "Layers of cells in every unit that unit_layers does not name",
                              .minimum = 1,
                              .maximum = 10000});
    visit(unit_layers, OptionField{.name = "unit_layers",
                                   .description = "Layers of single units, whole numbers; a unit is called by the "
                                                  "horizon that is its roof, the highest \"Top\": { H1 = 3 }",
                                   .minimum = 1,
                                   .maximum = 10000});
    visit(layer_thickness_m, OptionField{.name = "layer_thickness_m",
                                         .description = "Instead of layers: as many as make a unit's mean thickness "
                                                        "come out nearest to this",
                                         .minimum = 0,
                                         .exclusive_minimum = true});
    visit(layering,
          OptionField{.name = "layering",
                      .description = "How layers share the thickness of units that the next two do not name: all the "
                                     "same part of it, or all equally thick from the roof down or from the floor up",
                      .words = {"proportional", "parallel_to_top", "parallel_to_base"}});
    visit(parallel_to_top, OptionField{.name = "parallel_to_top", .description = "Units whose layers follow their roof"});
    visit(parallel_to_base,
          OptionField{.name = "parallel_to_base", .description = "Units whose layers follow their floor"});
  }
};

/// The function whose whole values are the levels between layers (coudert2024 S12, S13).
struct FindStratigraphicFunction {
  static constexpr std::string_view name = "stratigraphic_function";
  static constexpr int version = 2;
  LayerStageOptions options;

  Result<LayeredSpace> operator()(const UprightModel& upright, StageContext& context) const;
};

}  // namespace strataflow
