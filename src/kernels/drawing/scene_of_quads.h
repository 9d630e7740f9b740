#pragma once
#include "kernels/drawing/scene.h"
#include "model/corner_map.h"
#include "model/feature_mesh.h"
#include "model/quad_mesh.h"

namespace strataflow {

/// Quads, bold where an edge lies on a feature; those around an inner vertex of other than four quads are coloured by
/// how many it has.
Scene scene_of_quads(const QuadMesh& mesh);

/// A triangulation with the lines on which a coordinate of its map is a whole number; features are bold too.
Scene scene_of_map(const FeatureMesh& mesh, const CornerMap& map);

/// A triangulation with a small cross along the directions of each triangle of the field; triangles around a singular
/// point are coloured by its valence.
Scene scene_of_field(const FeatureMesh& mesh, const FrameField& field);

}  // namespace strataflow
