#pragma once
#include <string>
#include <vector>

#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "kernels/hexes/extrude_hexes.h"
#include "stages/extract_quads_stage.h"
#include "stages/verticalize_stage.h"

namespace strataflow {

/// The plan of a pillar grid (coudert2024 S7), in the place of quads.
struct CutPillars {
  static constexpr std::string_view name = "cut_pillars";
  static constexpr int version = 1;
  NoOptions options;

  Result<MeshedQuads> operator()(const FeatureMesh& problem, StageContext& context) const;
};

struct TakePlanOptions {
  std::vector<std::string> drop_alignment;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(drop_alignment,
          OptionField{.name = "drop_alignment", .description = "As verticalize's", .is_internal = true});
  }
};

/// The model as it stands, for columns that need not follow faults: in the place of an upright plan.
struct TakePlan {
  static constexpr std::string_view name = "take_plan";
  static constexpr int version = 2;
  TakePlanOptions options;

  Result<UprightModel> operator()(const VolumeMesh& tets, StageContext& context) const;
};

struct StairStepOptions {
  double edge_length_m = 0;  ///< wanted of columns; 0: a hundredth of the diagonal
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    visit(edge_length_m, OptionField{.name = "edge_length_m", .description = "As of quads", .is_internal = true});
  }
};

/// A stair-step grid (coudert2024 S7), in the place of extruded hexahedra.
struct StairStep {
  static constexpr std::string_view name = "stair_step";
  static constexpr int version = 1;
  StairStepOptions options;

  Result<ExtrudedHexes> operator()(const LayeredSpace& space, StageContext& context) const;
};

/// The plan that hexahedra stand on, as quads.
struct TakeHexPlan {
  static constexpr std::string_view name = "take_hex_plan";
  static constexpr int version = 1;
  NoOptions options;

  Result<MeshedQuads> operator()(const ExtrudedHexes& hexes, StageContext& context) const;
};

}  // namespace strataflow
