#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "model/triangle_soup.h"

namespace strataflow {

struct ReferenceModelOptions {
  std::optional<double> resolution_m = std::nullopt;  ///< length of triangle edges; absent: about 10 000 triangles
  /// Absent: sealed. Otherwise the surfaces as they are before cutting: each meshed on its own, stopping short of
  /// what it should touch by this share of its extent; negative: overshooting. In [−0.2, 0.2].
  std::optional<double> raw_ratio = std::nullopt;
  std::uint64_t seed = 1;  ///< of models drawn at random (dfn)
};

/// In the order of the comment below.
const std::vector<std::string_view>& reference_model_names();

/// Makes a model as one patch per entity, sealed and sharing points; the box starts at the origin.
/// - A1 … A6, B, C, D: the nine of pellerin2014 §4.2, rebuilt from their description: horizons H1 … (bottom up), faults
///   F1 … (west to east), erosion E, onlap surface U, Diapir, box sides Top, Bottom, North (+y), South, East (+x),
///   West. A1–A6, B and C fill the box 1600 × 930 × 500 m, D a cube of 120 m.
/// - nested-spheres, slab, wedge, variable-layers, bracket, impeller, smooth-closed: test shapes of §4.1 X11, X15, X16; torus: a ring.
/// - veins, onlap, sandbox, fault-network, dfn: classes of Table 4.1; see reference_plans.h and fracture_network.h.
/// - horizon-fault-pair: one wavy horizon H1 and one wavy steep fault F1 through it, 1 km wide, open and crossing each
///   other (with or without `raw_ratio`): 2 (1000 m / resolution)² triangles each, for measuring cuts.
/// All conform by construction but dfn, whose fractures the cutting kernel cuts. Fails with invalid_options for another
/// name, a resolution that is not between 1/2000 and 1/8 (onlap: 1/12) of the model's width, a ratio out of its domain,
/// or one for a model of closed shapes or fault-network, which have no raw variant.
Result<TriangleSoup> generate_reference_model(std::string_view name, const ReferenceModelOptions& options = {});

}  // namespace strataflow
