#pragma once
#include <cstdint>

#include "base/result.h"
#include "model/feature_mesh.h"
#include "model/quad_mesh.h"

namespace strataflow {

struct QuadSmoothing {
  std::int64_t rounds = 30;      ///< at most so many passes over all points
  double good_enough = 0.9;      ///< points whose worst quad has this scaled Jacobian stay
  double untangle_below = 0.15;  ///< if a quad stays worse, it and those around are unfolded together
};

struct SmoothingReport {
  double before = 0, after = 0;  ///< smallest scaled Jacobian
  std::uint64_t moves = 0;
  std::int64_t rounds = 0;
};

/// Moves points to raise the scaled Jacobians of quads that came from `mesh`: corners stay, points on features slide
/// along them (on them to rounding), the others move in the plane, or on the surface. A point moves only if the
/// worst quad around it gets no worse, so nothing that is right turns over. Quads that stay turned over are unfolded
/// together with those around them, if that makes the worst of all better. One point after the other, in order. Fails
/// with internal_error if a labelled point is not on a feature of the mesh.
Result<SmoothingReport> smooth_quads(QuadMesh& quads, const FeatureMesh& mesh, const QuadSmoothing& options = {});

}  // namespace strataflow
