#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/result.h"
#include "model/input_data.h"
#include "model/volume_mesh.h"

namespace strataflow {

struct VolumeFrameOptions {
  double lambda = 4.5;           ///< orthogonality; 4.5 is the distance of the polynomials themselves (S32)
  double unit_penalty = 0.01;    ///< ε of S33
  double time = 1;               ///< τ of S33
  std::int64_t iterations = 30;  ///< diffusions at most
  std::int64_t inner = 40;       ///< L-BFGS steps of each
  double settled_ratio = 1e-4;
  std::function<bool()> is_cancelled = {};
};

using VolumeFrame = std::array<Vec3, 3>;  ///< unit vectors, right-handed; signs and order mean nothing

struct VolumeFrames {
  std::vector<VolumeFrame> frames;  ///< per cell
  double energy = 0;                ///< (3.32)
  std::int64_t iterations = 0;
  double smallest_determinant = 1;  ///< of the three vectors, over all cells
  std::vector<Polyline> singular;   ///< curves of inner edges around which the frames do not close, cut where they meet
};

/// A frame per tetrahedron, its directions not necessarily orthogonal, as smooth as the boundary lets it be
/// (coudert2024 S32, S33): fourth powers of the directions in spherical harmonics, Algorithm 1 with analytic gradients.
/// Directions are gradients: every boundary face fixes one to its normal, up to three per cell, those nearly parallel
/// to an earlier one left out; where no cell has both faces of a sharp edge, all cells around it take both normals. Starts from crosses spread from the boundary, or from `start`. No hexahedral mesh is
/// promised: the singular curves may belong to none. Fails with invalid_input for cells that are no tetrahedra,
/// inverted, or not manifold.
Result<VolumeFrames> compute_volume_frames(const VolumeMesh& mesh, const VolumeFrameOptions& options = {},
                                           const std::vector<VolumeFrame>& start = {});

}  // namespace strataflow
