#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "model/feature_mesh.h"

namespace strataflow {

/// What lies around a point between two neighbouring features, or the whole surroundings of a point without feature.
enum class NodeKind : std::uint8_t {
  inside,  ///< a point without feature, not on the boundary
  sector,  ///< from one feature edge to the next
  open     ///< a side of it is a free boundary
};

/// The half-edges of a FeatureMesh, cut along its features. A *node* is a sector of a point; corners (= half-edges by
/// their origin) of one node follow counter-clockwise. A *compartment* is what can be reached without crossing a
/// feature.
struct FeatureLayout {
  std::vector<std::uint32_t> opposite;    ///< per half-edge; no_index on the boundary
  std::vector<std::uint8_t> is_feature;   ///< per half-edge
  std::vector<std::uint32_t> feature;     ///< per half-edge: the lowest feature on it, or no_index
  std::vector<double> length_m;           ///< per half-edge
  std::vector<double> angle;              ///< per corner, radians
  std::vector<double> area_m2;            ///< per triangle
  std::vector<std::uint32_t> node_of;     ///< per corner
  std::vector<std::uint32_t> node_first;  ///< per node, plus one: into node_corners
  std::vector<std::uint32_t> node_corners;
  std::vector<NodeKind> node_kind;         ///< per node
  std::vector<std::uint32_t> node_point;   ///< per node
  std::vector<std::uint32_t> point_first;  ///< per point, plus one: into point_nodes
  std::vector<std::uint32_t> point_nodes;  ///< ascending in each point
  std::vector<std::uint32_t> compartment;  ///< per triangle
  std::uint32_t compartment_count = 0;

  std::size_t triangle_count() const { return area_m2.size(); }
  std::uint32_t node_count() const { return static_cast<std::uint32_t>(node_kind.size()); }
  std::span<const std::uint32_t> corners_of(std::uint32_t node) const {
    return {node_corners.data() + node_first[node], node_corners.data() + node_first[node + 1]};
  }
  std::span<const std::uint32_t> nodes_of(std::uint32_t point) const {
    return {point_nodes.data() + point_first[point], point_nodes.data() + point_first[point + 1]};
  }
};

constexpr std::uint32_t next_half_edge(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
constexpr std::uint32_t previous_half_edge(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

/// Fails with invalid_input, naming the triangle, edge or point, when the mesh is not manifold, not oriented, has a
/// triangle without area, a number that is not finite, an index out of range, or a feature edge that is no edge.
Result<FeatureLayout> build_feature_layout(const FeatureMesh& mesh);

/// "point 12 at (3, 4, 0)" in the file's coordinates.
std::string name_point(const FeatureMesh& mesh, std::uint32_t point);

/// The name of the feature of a half-edge, or "the surface" away from features.
std::string name_feature(const FeatureMesh& mesh, const FeatureLayout& layout, std::uint32_t half_edge);

}  // namespace strataflow
