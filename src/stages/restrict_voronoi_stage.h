#pragma once
#include "base/option_field.h"
#include "base/result.h"
#include "graph/stage_context.h"
#include "model/built_model.h"
#include "model/restricted_diagram.h"
#include "model/site_set.h"

namespace strataflow {

/// Cuts a model's triangles into the pieces of the cells of sites (pellerin2014 §2.3). Fails with invalid_input when
/// there are no sites.
struct RestrictVoronoi {
  static constexpr std::string_view name = "restricted_voronoi";
  static constexpr int version = 1;
  NoOptions options;

  Result<RestrictedDiagram> operator()(const BuiltModel& built, const SiteSet& sites, StageContext& context) const;
};

}  // namespace strataflow
