#pragma once
#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "kernels/quality/nearest_triangle.h"
#include "model/structural_model.h"

namespace strataflow {

struct HausdorffOptions {
  double error_ratio = 1e-4;  ///< largest error allowed, in the diagonal of the box around both meshes; > 0
  /// About so many samples in each direction besides corners, spent where the mesh may lie farthest: where they do not
  /// suffice the error is larger, and `bound_m` says by how much. Absent: as many as the error takes.
  std::optional<std::uint64_t> samples = std::nullopt;
  std::function<bool()> is_cancelled = {};  ///< asked now and then
};

/// sup over one mesh of the distance to the other. The true value lies in [distance_m, bound_m].
struct DirectedDistance {
  double distance_m = 0;      ///< largest distance of a sample
  double bound_m = 0;         ///< no point of the mesh is farther
  Vec3 at;                    ///< the sample
  std::uint64_t samples = 0;  ///< points whose distance was computed
  template <class A>
  void archive(A& a) {
    a(distance_m, bound_m, at, samples);
  }
};

/// Both directions (pellerin2014 §2.9).
struct HausdorffDistance {
  DirectedDistance forward;   ///< from the first mesh to the second
  DirectedDistance backward;  ///< from the second to the first
  double diagonal_m = 0;      ///< of the box around the first mesh
  double distance_m() const { return std::max(forward.distance_m, backward.distance_m); }
  double bound_m() const { return std::max(forward.bound_m, backward.bound_m); }
  double ratio() const { return diagonal_m > 0 ? distance_m() / diagonal_m : 0; }
  template <class A>
  void archive(A& a) {
    a(forward, backward, diagonal_m);
  }
};

/// Branch and bound instead of a fixed sampling: a piece of a triangle whose three corners lie within u of one and the
/// same triangle of the other mesh lies within u of it altogether, since the distance to a convex set is convex. Pieces
/// are split until none can exceed the largest distance found by more than the allowed error.
/// Fails with invalid_input when one of the meshes is empty, with invalid_options, cancelled.
Result<HausdorffDistance> hausdorff_distance(const TriangleMesh& first, const TriangleMesh& second,
                                             const HausdorffOptions& options = {});

/// The distance between the parts of two models that belong to entities of the same name.
struct EntityDistance {
  std::string name;
  bool is_missing = false;  ///< in one of the models: there is no distance
  HausdorffDistance distance;
  template <class A>
  void archive(A& a) {
    a(name, is_missing, distance);
  }
};

/// Per entity of the first model that has triangles, then those of the second alone. A surface that several entities
/// share counts for each of them.
Result<std::vector<EntityDistance>> hausdorff_by_entity(const StructuralModel& first, const StructuralModel& second,
                                                        const HausdorffOptions& options = {});

}  // namespace strataflow
