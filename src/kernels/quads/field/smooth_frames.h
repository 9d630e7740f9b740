#pragma once
#include <array>
#include <vector>

#include "base/result.h"
#include "kernels/quads/field/field_topology.h"

namespace strataflow {

/// Two gradient directions per triangle in the true geometry, as smooth as features and a given topology let them be:
/// least squares of the differences between matched directions over edges, plus `orthogonality` times the squared
/// deviation from right angles per quad of area. Linear, so one sparse solve; in the sector of an acute corner both
/// directions come out constant, each standing on its side. `alpha` and `angle`: the crosses of smooth_cross_field
/// and their metric. Pairs that come out less than 3° or more than 177° apart are replaced by crosses.
Result<std::vector<std::array<double, 2>>> smooth_frames(const FeatureMesh& mesh, const FeatureLayout& layout,
                                                         const std::vector<double>& angle,
                                                         const std::vector<double>& alpha,
                                                         const FieldTopology& topology, double orthogonality = 0.05);

}  // namespace strataflow
