#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "kernels/quads/field/feature_layout.h"
#include "kernels/quads/integer_constraint.h"
#include "model/corner_map.h"

namespace strataflow {

/// All constraints of a map, eliminated: U = M·X + B with ker M = 0 (coudert2024 S43). Charts are turned so that they
/// agree off a cut graph; a *place* is a set of corners that share one value then. Scalar 2·place + axis of the map is
/// constant[s] + Σ coefficient · X[unknown] over its entries.
struct MapReduction {
  struct Entry {
    std::uint32_t unknown = 0;
    double coefficient = 0;
  };
  std::vector<std::uint8_t> chart;      ///< per triangle: quarter turns from its chart into the common one
  std::vector<std::uint32_t> place_of;  ///< per corner
  std::vector<std::uint32_t> first;     ///< per scalar, plus one: into entries
  std::vector<Entry> entries;
  std::vector<double> constant;  ///< per scalar
  std::uint32_t unknowns = 0;
  std::uint32_t cut_edges = 0;

  std::uint32_t place_count() const { return static_cast<std::uint32_t>(constant.size() / 2); }

  /// M·X + B in the common chart, per scalar.
  std::vector<double> scalars(const std::vector<double>& x) const;
};

/// Eliminates exactly: seams U_h = i^turns U_succ(opp h) + t with free t (no cut and no t where charts agree), feature
/// edges on their axes, `constraints`, and a pin for what is still free to slide as a whole. Fails with
/// geometry_failed, naming feature and place, when constraints contradict each other or squeeze a feature to length
/// zero (`stuck` gets its triangle); invalid_input when arrays do not fit the mesh.
Result<MapReduction> reduce_map(const FeatureMesh& mesh, const FeatureLayout& layout,
                                const std::vector<std::uint8_t>& turns, const std::vector<MapAxis>& axes,
                                const std::vector<IntegerConstraint>& constraints = {},
                                std::vector<std::uint32_t>* stuck = nullptr);

}  // namespace strataflow
