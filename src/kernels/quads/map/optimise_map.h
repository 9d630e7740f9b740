#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "base/result.h"
#include "kernels/quads/integer_constraint.h"
#include "kernels/quads/map/foldover_free.h"
#include "model/corner_map.h"
#include "model/feature_mesh.h"

namespace strataflow {

struct MapReport {
  std::int64_t unknowns = 0, cut_edges = 0;
  FoldoverFreeReport foldover_free;
  template <class A>
  void archive(A& a) {
    a(unknowns, cut_edges, foldover_free);
  }
};

struct OptimisedMap {
  CornerMap map;
  MapReport report;
  template <class A>
  void archive(A& a) {
    a(map, report);
  }
};

/// A valid map of the mesh that follows the field's turns and axes and all `constraints`: every triangle has positive
/// area, features lie on isolines exactly (coudert2024 S35, S43, S44). Without constraints it is seamless; with those
/// of a quantization it is grid-preserving. Integrates the field, then optimises; `start`, a map with the same turns,
/// is carried over to the constraints instead (carry_map), and only where that gets stuck a new start is made from it.
/// Fails with geometry_failed, naming the feature and the place, when constraints contradict each other or triangles
/// stay flipped; `stuck` gets these triangles.
Result<OptimisedMap> optimise_map(const FeatureMesh& mesh, const FrameField& field,
                                  const std::vector<IntegerConstraint>& constraints = {},
                                  const CornerMap* start = nullptr, const FoldoverFreeOptions& options = {},
                                  std::vector<std::uint32_t>* stuck = nullptr);

/// Where a map fails its own rules, for tests and for the report of failures (R13).
struct MapDefects {
  double seam = 0;                ///< largest |ω_h + i^turns ω_opp| over the mesh's largest edge in the map
  double off_axis = 0;            ///< largest constant-coordinate change along a feature edge
  std::int64_t flipped = 0;       ///< triangles whose corners do not turn counter-clockwise
  std::int64_t wrong_angles = 0;  ///< points whose angles in the map do not sum up to valence · π/2
  std::uint32_t first_wrong_point = 0;
};
Result<MapDefects> measure_map(const FeatureMesh& mesh, const CornerMap& map);

}  // namespace strataflow
