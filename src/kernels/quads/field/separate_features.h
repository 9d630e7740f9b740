#pragma once
#include "base/result.h"
#include "model/feature_mesh.h"

namespace strataflow {

/// Splits, at its middle, every inner edge that is no feature but joins two points of features, and puts a point into
/// every triangle that features enclose. Then each triangle has at most one feature edge and a point off the features,
/// so a map can open any corner, keep any chain of edges straight, and singular points have room beside every feature
/// (coudert2024 S28 asks for the opposite, one triangle holding both edges of a sharp corner; the angles of our fast
/// field are opened instead, and a single triangle could not hold a corner of more than 180°). Compartments with too few
/// points inside for the singular points that their outline asks for are refined. Points keep their numbers; new ones
/// follow. Fails like build_feature_layout.
Result<FeatureMesh> separate_features(const FeatureMesh& mesh);

}  // namespace strataflow
