#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "model/corner_map.h"
#include "model/feature_mesh.h"

namespace strataflow {

/// The mesh without the edges of these features (ascending): nothing but their corners holds the quads there.
FeatureMesh without_features(const FeatureMesh& mesh, const std::vector<std::uint32_t>& features);

/// Their edges, ascending as in the mesh.
std::vector<FeatureEdge> edges_of_features(const FeatureMesh& mesh, const std::vector<std::uint32_t>& features);

/// The feature that comes nearest to any of the triangles, counted in triangles, of those as near the one with most
/// edges there, then the lowest: what a map that folds there could do without. None for features with an edge on the
/// boundary.
std::optional<std::uint32_t> loosest_feature(const FeatureMesh& mesh, const std::vector<std::uint32_t>& triangles);

/// Gives edges of these features the axis that they are near in the map, so that quantization may align them
/// (coudert2024 S43); features with an edge more than 30° off both axes are left out. Returns those that got one.
std::vector<std::uint32_t> take_near_axes(const FeatureMesh& mesh, const std::vector<std::uint32_t>& features,
                                          CornerMap& map);

}  // namespace strataflow
