#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "model/structural_model.h"

namespace strataflow {

/// What no bending can change about a triangle complex, non-manifold or not: χ = V − E + F = b0 − b1 + b2, Betti
/// numbers with coefficients mod 2 (pellerin2014 §2.9).
struct TopologyInvariants {
  std::uint64_t vertices = 0, edges = 0, triangles = 0;
  std::uint64_t components = 0;      ///< b0
  std::int64_t independent_loops = 0;  ///< b1
  std::uint64_t cavities = 0;        ///< b2: in space, the closed volumes
  std::uint64_t borders = 0;         ///< connected pieces of the edges with one triangle
  std::int64_t euler() const {
    return static_cast<std::int64_t>(vertices) - static_cast<std::int64_t>(edges) +
           static_cast<std::int64_t>(triangles);
  }
  friend bool operator==(const TopologyInvariants&, const TopologyInvariants&) = default;
  template <class A>
  void archive(A& a) {
    a(vertices, edges, triangles, components, independent_loops, cavities, borders);
  }
};

/// Of the triangles given; vertices that none of them uses do not count. Triangles have three different vertices, and
/// none comes twice.
TopologyInvariants topology_invariants(std::span<const Triangle> triangles);

struct ModelTopology {
  TopologyInvariants whole;
  std::vector<TopologyInvariants> surfaces;  ///< each by itself
  template <class A>
  void archive(A& a) {
    a(whole, surfaces);
  }
};

ModelTopology topology_of(const StructuralModel& model);

}  // namespace strataflow
