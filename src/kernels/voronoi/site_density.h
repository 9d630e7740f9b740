#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "model/structural_model.h"

namespace strataflow {

/// What sites crowd at.
enum class DensityKind : std::uint8_t {
  uniform,
  near_corners,  ///< (1 − d / d_max)⁴, d the distance to the nearest corner (pellerin2014 §1.6)
  near_lines,    ///< the same of the nearest line
  curvature,     ///< where surfaces bend: spacing in proportion to the radius
  property       ///< of the points, which must be positive
};

struct DensityOptions {
  DensityKind kind = DensityKind::uniform;
  std::string property{};             ///< its name, where kind is property
  double smallest_ratio = 1e-3;       ///< densities below this share of the largest are raised to it; (0, 1]
  /// Per surface: the length that edges shall have there instead of `edge_length_m`; empty: nowhere.
  std::vector<double> surface_edge_length_m{};
  double edge_length_m = 1;           ///< what the rest has
};

/// Density of sites per point of the model, positive, 1 at most where not raised by a surface's own edge length. The
/// spacing of a centroidal tessellation is in proportion to density^(−1/4) (pellerin2014 §2.4); a point of several
/// surfaces takes the shortest edge among them. Empty: 1 everywhere.
/// Fails with invalid_input when the property is missing, of several values a point, or not positive anywhere.
Result<std::vector<double>> site_density(const StructuralModel& model, const DensityOptions& options);

}  // namespace strataflow
