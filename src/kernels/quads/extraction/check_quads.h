#pragma once
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "model/feature_mesh.h"
#include "model/quad_mesh.h"

namespace strataflow {

/// Vertices minus edges plus faces, of faces with three or four corners.
std::int64_t euler_characteristic(std::size_t point_count, const std::vector<Triangle>& triangles);
std::int64_t euler_characteristic(std::size_t point_count, const std::vector<std::array<std::uint32_t, 4>>& quads);

/// Quads around each point of a quad mesh.
std::vector<std::uint32_t> quad_valence(const QuadMesh& quads);

/// Per point: whether it lies on the boundary.
std::vector<char> boundary_points(const QuadMesh& quads);

/// Per face of three or four corners: the least face that it is joined to across edges that are no features (sorted as
/// FeatureMesh::edges are). Quads and triangles of one smooth piece of surface share their normals' side.
std::vector<std::uint32_t> smooth_patches(const std::vector<Triangle>& triangles, const std::vector<FeatureEdge>& features);
std::vector<std::uint32_t> smooth_patches(const std::vector<std::array<std::uint32_t, 4>>& quads,
                                          const std::vector<FeatureEdge>& features);

/// Whether the quads are a manifold: four different corners each, coherently oriented, at most two at an edge, one fan
/// around each point, no unused point; and whether labelled edges are edges of quads. Fails with geometry_failed.
Result<void> check_quads(const QuadMesh& quads);

/// The maximal chains of a feature's edges in a mesh, between `corners` (ascending) and points where it does not go
/// straight on, or closed (then the first point is repeated). Ordered by their first edge.
std::vector<std::vector<std::uint32_t>> feature_chains(const std::vector<FeatureEdge>& edges,
                                                       const std::vector<std::uint32_t>& corners,
                                                       std::uint32_t feature);

}  // namespace strataflow
