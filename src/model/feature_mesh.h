#pragma once
#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <vector>

#include "model/triangle_soup.h"
#include "model/volume_mesh.h"

namespace strataflow {

/// An edge that a quad mesh must follow.
struct FeatureEdge {
  std::uint32_t a = 0, b = 0;  ///< points, a < b
  std::uint32_t feature = 0;   ///< index into FeatureMesh::features
  friend auto operator<=>(const FeatureEdge&, const FeatureEdge&) = default;
  static constexpr bool is_flat = true;
};

/// A curve that a quad mesh must follow as a chain of edges: a fault trace, a side of the outline, a hole, a well.
struct Feature {
  std::string name;
  Role role = Role::curve;
  /// How many rows of quads must lie beside it up to the feature `strip_of`; 0: any number (coudert2024 S20).
  std::uint32_t strip_quads = 0;
  std::int32_t strip_of = -1;
  template <class A>
  void archive(A& a) {
    a(name, role, strip_quads, strip_of);
  }
};

/// A triangulated surface, oriented and manifold, with the edges that a quad mesh must follow. Half-edge h = 3·t + k runs from
/// corner k of triangle t to corner (k + 1) mod 3 (topology/building/edge_table.h). In the plane z is 0 and triangles
/// turn counter-clockwise seen from above. All boundary edges are features unless the boundary is free.
struct FeatureMesh {
  Vec3 local_origin;  ///< add it to get the file's own coordinates
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;
  std::vector<FeatureEdge> edges;      ///< ascending by a, b, feature; an edge may have several features
  std::vector<Feature> features;
  std::vector<std::uint32_t> corners;  ///< points that must become vertices: ends, junctions, sharp turns; ascending
  double edge_length_m = 0;            ///< wanted of quads
  std::vector<Change> changes;         ///< what cleaning moved or merged
  template <class A>
  void archive(A& a) {
    a(local_origin, points, triangles, edges, features, corners, edge_length_m, changes);
  }
};

}  // namespace strataflow
