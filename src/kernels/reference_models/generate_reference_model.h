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
};

/// A1 … A6, B, C, D and horizon-fault-pair.
const std::vector<std::string_view>& reference_model_names();

/// The nine models of pellerin2014 §4.2, rebuilt from their description, as one patch per entity: horizons H1 …
/// (bottom up), faults F1 … (west to east), erosion E, onlap surface U, Diapir, box sides Top, Bottom, North (+y),
/// South, East (+x), West. Sealed ones are conforming by construction and share points. A1–A6, B and C fill the box
/// 1600 × 930 × 500 m, D a cube of 120 m; both start at the origin.
/// "horizon-fault-pair" is one wavy horizon H1 and one wavy steep fault F1 through it, 1 km wide, open and crossing
/// each other (with or without `raw_ratio`): 2 (1000 m / resolution)² triangles each, for measuring cuts. Fails with
/// invalid_options for another name, a resolution that is not between 1/2000 and 1/8 of the model's width, or a ratio
/// out of its domain.
Result<TriangleSoup> generate_reference_model(std::string_view name, const ReferenceModelOptions& options = {});

}  // namespace strataflow
