#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "kernels/quads/field/feature_layout.h"

namespace strataflow {

/// How the frames of neighbouring triangles correspond, and the quads around every node that follow from it.
struct FieldTopology {
  std::vector<std::uint8_t> turns;  ///< per half-edge: FrameField::turns
  std::vector<double>
      residual;  ///< per half-edge, radians: how far the neighbour's frame, once matched, lies ahead of ours
  std::vector<std::int8_t> label;   ///< per half-edge of a feature: its direction in the map is i^label; −1 elsewhere
  std::vector<std::int32_t> quads;  ///< per node; rounded on a free boundary
};

/// Matches frames (two directions per triangle as in FrameField, in the metric of `angle`) with the neighbours' that
/// are nearest in the sum of both angles (coudert2024 S30), labels feature edges by the direction they are fixed to,
/// and counts quads: (π/2) · quads = Σ angles + Σ residuals around the node.
FieldTopology match_frames(const FeatureLayout& layout, const std::vector<double>& angle,
                           const std::vector<std::array<double, 2>>& frames);

/// What settle_singularities did.
struct SettledSingularities {
  std::uint32_t off_features = 0;  ///< quarter turns taken from sectors to points inside
  std::uint32_t spread = 0;     ///< quarter turns moved between points inside because of a valence below 3 or above 5
  std::uint32_t cancelled = 0;  ///< pairs removed
};

/// Takes singular points off features: where a sector has other than `corner_quads` quads, the difference goes to a
/// neighbour inside, over the edge where the frames differ most that way. Then valences outside 3 … 5 are spread over
/// neighbours where these can take it, and pairs of valence 3 and 5 cancel when the path between them costs at most
/// `cancel_cost`: a path costs per edge its length in quads times the growth of the squared residual, in units of
/// (π/2)², weighted like the smooth field. Fails with invalid_input when a sector has no neighbour inside
/// (separate_features first).
Result<SettledSingularities> settle_singularities(const FeatureMesh& mesh, const FeatureLayout& layout,
                                                  const std::vector<std::uint8_t>& corner_quads, double cancel_cost,
                                                  FieldTopology& topology);

/// Σ (4 − valence) inside + Σ (2 − quads) on the boundary, which is 4 χ on every mesh with an aligned boundary (R12).
std::int64_t index_sum(const FeatureMesh& mesh, const FeatureLayout& layout, const FieldTopology& topology);

/// V − E + F.
std::int64_t euler_characteristic(const FeatureMesh& mesh, const FeatureLayout& layout);

}  // namespace strataflow
