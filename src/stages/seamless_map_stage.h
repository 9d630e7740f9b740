#pragma once
#include "kernels/quads/map/seamless_map.h"
#include "stages/frame_field_stage.h"

namespace strataflow {

/// A map along the field, without folds, with every feature on an isoline (coudert2024 S34, S35, S44). Where the
/// field's map stays folded, fields with more and with fewer singular points are tried, then maps without the features
/// nearest to the folds; the output holds the field it follows and these features.
struct SeamlessMap {
  static constexpr std::string_view name = "seamless_map";
  static constexpr int version = 2;
  FrameFieldStageOptions options;

  Result<Attempt<FieldAndMap>> operator()(const FeatureMesh& mesh, const Attempt<FrameFieldResult>& field,
                                          StageContext& context) const;
};

}  // namespace strataflow
