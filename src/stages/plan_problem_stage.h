#pragma once
#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "kernels/quads/plan/feature_mesh_of_surface.h"
#include "kernels/quads/plan/plan_options.h"
#include "model/feature_mesh.h"
#include "model/input_data.h"

namespace strataflow {

/// What quads are to follow: curves of the plan, or the sharp edges, borders and labels of surfaces.
struct PlanProblemOptions {
  PlanOptions plan;
  double feature_deg = 40;
  bool by_label = true;
  SurfaceFeatureOptions on_surfaces() const {
    SurfaceFeatureOptions surface;
    surface.edge_length_m = plan.edge_length_m;
    surface.corner_deg = plan.corner_deg;
    surface.feature_deg = feature_deg;
    surface.by_label = by_label;
    return surface;
  }
  template <class Visitor>
  void visit_fields(Visitor& visit) {
    plan.visit_fields(visit);
    visit(feature_deg, OptionField{.name = "feature_deg",
                                   .description = "On surfaces: edges where the normals differ by more are features",
                                   .minimum = 1,
                                   .maximum = 180});
    visit(by_label, OptionField{.name = "by_label",
                                .description = "On surfaces: whether edges between entities are features"});
  }
};

/// The triangulated problem of quad meshing (coudert2024 S10): the cleaned curves of the input seen from above, or its
/// surfaces where it has any. Every triangle has a point off the features, so that a map exists.
struct PlanProblem {
  static constexpr std::string_view name = "plan_problem";
  static constexpr int version = 1;
  PlanProblemOptions options;

  Result<FeatureMesh> operator()(const InputData& input, StageContext& context) const;
};

}  // namespace strataflow
