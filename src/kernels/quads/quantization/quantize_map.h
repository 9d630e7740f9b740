#pragma once
#include "base/result.h"
#include "kernels/quads/integer_constraint.h"
#include "kernels/quads/quantization/cut_chart.h"
#include "kernels/quads/quantization/decimate_map.h"
#include "kernels/quads/quantization/optimise_vectors.h"
#include "model/corner_map.h"
#include "model/feature_mesh.h"

namespace strataflow {

struct QuantizeOptions {
  double quads_per_unit = 1;  ///< > 0; the map is scaled by it first
  bool coarse = false;        ///< as few quads as a valid map allows (S40): the scale is 1/100 of the above
  bool keep_shape = false;    ///< keep every bend of free boundaries and of features that the map does not follow;
                              ///< imprint_quantization needs it if there are any
  /// Points where quads have no room to be convex, as often as that was found: around one named k times, vectors
  /// between kept points are wanted k + 1 quads long at least. A wish, weighed against the others.
  std::vector<std::uint32_t> crowded = {};
};

/// Integers for a seamless map.
struct Quantization {
  FlatMesh flat;  ///< the map, exactly closed and seamless
  CutChart cut;
  DecimatedMap decimated;
  IntegerVectors integers;  ///< of the decimated mesh's half-edges, in its charts
  /// A·U = ω (S37), as few equations as fix all integers, and for each piece of surface one point at an integer (S43).
  /// Terms at 3·triangles + k are the offset Y of formula (4.12) of the k-th point of kind `free`, ascending.
  /// A kept point on a feature has no offset, not even along it: it becomes an integer.
  std::vector<IntegerConstraint> constraints;
  std::uint32_t offsets = 0;                  ///< number of Y
  std::vector<std::uint32_t> unmet_features;  ///< features that could not be aligned or given their rows, ascending
  std::vector<std::uint32_t> unaligned_features{};  ///< of these, those that could not be aligned
};

/// Algorithm 4 (S37): decimation with tracked forms, Algorithm 5, constraints. `map` is seamless in units of one quad:
/// every triangle positive, features on their axes or near them. Features with `strip_quads` get that many rows of
/// quads up to the feature `strip_of` (S20). Fails with invalid_options, invalid_input (the map; named) or
/// geometry_failed.
Result<Quantization> quantize_map(const FeatureMesh& mesh, const CornerMap& map, const QuantizeOptions& options = {});

}  // namespace strataflow
