#pragma once
#include <string>
#include <vector>

#include "model/built_model.h"
#include "stages/plan_problem_stage.h"

namespace strataflow {

/// Surfaces of a model that quads are wanted on, and what they must follow there.
struct PlanSurfacesOptions {
  PlanProblemOptions problem;
  std::vector<std::string> surfaces;
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    problem.visit_fields(visit);
    visit_surfaces(visit, surfaces);
  }
  template <class Visitor>
  static void visit_surfaces(Visitor& visit, std::vector<std::string>& surfaces) {
    visit(surfaces, OptionField{.name = "surfaces",
                                .description = "Quads are made on these entities of the cut and sealed model, along "
                                               "the lines where they meet others; none: on the input as it is"});
  }
};

/// The problem of quad meshing on some entities of a model, its lines and corners as features (coudert2024 S10, for
/// surfaces in space). Fails with invalid_options for a name that is no entity, invalid_input where the entities
/// together are not a manifold.
struct PlanSurfaces {
  static constexpr std::string_view name = "plan_surfaces";
  static constexpr int version = 1;
  PlanSurfacesOptions options;

  Result<FeatureMesh> operator()(const BuiltModel& built, StageContext& context) const;
};

}  // namespace strataflow
