#pragma once
#include <string>
#include <vector>

#include "model/feature_mesh.h"
#include "model/quad_mesh.h"

namespace strataflow {

/// Features of the mesh that the quads do not follow over their whole length, one line each; none is good
/// (coudert2024 R19). A feature is followed if every vertex of its labelled edges lies on it, to 1e-9 of the extent, and
/// on each of its chains between corners labelled edges lead from end to end, always forwards. Where the boundary is free, a chain that ends there may stop two edge lengths
/// short, for cells that the boundary cuts are left out.
std::vector<std::string> features_not_followed(const FeatureMesh& mesh, const QuadMesh& quads);

}  // namespace strataflow
