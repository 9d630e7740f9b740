#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "model/feature_mesh.h"

namespace strataflow {

/// Quadrilaterals that conform to every feature.
struct QuadMesh {
  Vec3 local_origin;
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 4>> quads;  ///< counter-clockwise, manifold
  std::vector<FeatureEdge> edges;                   ///< quad edges on features, ascending by a, b, feature
  std::vector<Feature> features;
  std::vector<std::uint32_t> corner_points;         ///< per FeatureMesh::corners: its point
  std::vector<Change> changes;
  template <class A>
  void archive(A& a) {
    a(local_origin, points, quads, edges, features, corner_points, changes);
  }
};

}  // namespace strataflow
