#pragma once
#include "model/feature_mesh.h"
#include "model/quad_mesh.h"

namespace strataflow {

/// The last resort: every triangle becomes three quads around its centre and the middles of its edges (coudert2024 S3).
/// Always works, with features as chains of edges; topology and shape are poor.
QuadMesh subdivide_mesh(const FeatureMesh& mesh);

}  // namespace strataflow
