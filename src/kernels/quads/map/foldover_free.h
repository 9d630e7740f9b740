#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "base/result.h"
#include "kernels/quads/map/map_energy.h"

namespace strataflow {

struct FoldoverFreeOptions {
  std::int64_t iterations = 100;  ///< at most, of each start
  double area_weight = 0.5;       ///< of the determinant against the angles
  double tolerance = 1e-3;        ///< stop when a step gains less than this share of the energy
  bool may_start_afresh = true;   ///< optimise_map: from least squares where an earlier map cannot be carried over
  std::function<bool()> is_cancelled = {};
};

struct FoldoverFreeReport {
  std::int64_t iterations = 0;
  std::int64_t flipped_before = 0, flipped = 0;
  double energy = 0;  ///< mean over the area; 2 + 2 · area_weight for an isometry
  double smallest_determinant = 0;
  std::uint32_t worst_triangle = 0;
  std::string stopped_by;
  template <class A>
  void archive(A& a) {
    a(iterations, flipped_before, flipped, energy, smallest_determinant, worst_triangle, stopped_by);
  }
};

/// Garanzha 2021 (coudert2024 S44) in the plane: minimises Σ area · (|J|² + θ (det² + 1)) / χ(det, ε) over X, J the
/// map's derivative in units of the quad edge, by Newton steps with each triangle's second derivatives made positive; ε
/// falls with the worst determinant until every triangle has positive area, then the map is polished. Starts again
/// with another ε, up to four times, when triangles stay folded. Fails with
/// geometry_failed only when a linear system breaks down; `flipped` tells whether it succeeded.
Result<FoldoverFreeReport> make_foldover_free(MapEnergy& energy, std::vector<double>& x,
                                              const FoldoverFreeOptions& options = {});

/// Value and derivatives of the energy of one linear part; the second derivatives are projected to the nearest
/// positive semidefinite ones.
LinearDerivatives foldover_energy(const LinearPart& part, double area_weight, double epsilon);

}  // namespace strataflow
