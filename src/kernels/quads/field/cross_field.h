#pragma once
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "kernels/quads/field/feature_layout.h"

namespace strataflow {

struct CrossFieldOptions {
  std::int64_t diffusions = 4;  ///< normalised and diffused again so often (Viertel and Osting 2019)
  double time_ratio = 20;       ///< diffusion length in quad edges
};

/// A cross per triangle: the angle of one of its arms against the triangle's first half-edge, in the metric of
/// `angle` (corners; straighten_angles), counter-clockwise. Arms lie along every feature edge exactly. The linear cross
/// field of Palacios and Zhang 2007 (coudert2024 S29): one complex number e^{4iα} per triangle, one factorisation.
Result<std::vector<double>> smooth_cross_field(const FeatureMesh& mesh, const FeatureLayout& layout,
                                               const std::vector<double>& angle, const CrossFieldOptions& options = {});

}  // namespace strataflow
