#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "kernels/hexes/layered_space.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// [hex]: the plan.
struct VerticalizeOptions {
  std::vector<std::string> drop_alignment;
  bool follow_horizon_lines = false;
  std::int64_t untangling_steps = 600;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(drop_alignment,
          OptionField{.name = "drop_alignment",
                      .description = "Entities that hexahedra need not follow: faults so named displace layers but are "
                                     "no faces, other surfaces count as if they were not there"});
    visit(follow_horizon_lines, OptionField{.name = "follow_horizon_lines",
                                            .description = "Edges of cells follow the lines where horizons meet"});
    visit(untangling_steps,
          OptionField{
              .name = "untangling_steps",
              .description = "Steps of the optimisation that turns tetrahedra back where faults lean far, at most",
              .minimum = 0,
              .maximum = 100000});
  }
};

/// The plan of a model in which faults and sides stand upright (coudert2024 S8, S16–S19).
struct Verticalize {
  static constexpr std::string_view name = "verticalize";
  static constexpr int version = 5;
  VerticalizeOptions options;

  Result<UprightModel> operator()(const VolumeMesh& tets, StageContext& context) const;
};

/// The curves that the plan of quads follows: traces of faults and sides of the upright model, and the wells of the
/// input.
struct TakePlanLines {
  static constexpr std::string_view name = "take_plan_lines";
  static constexpr int version = 1;
  NoOptions options;

  Result<InputData> operator()(const UprightModel& upright, const InputData& input, StageContext& context) const;
};

}  // namespace strataflow
