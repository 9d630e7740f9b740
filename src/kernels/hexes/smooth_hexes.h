#pragma once
#include <array>
#include <cstdint>

#include "kernels/hexes/extrude_hexes.h"

namespace strataflow {

struct SmoothHexesOptions {
  std::int64_t sweeps = 10;     ///< ≥ 0
  double below_quality = 0.6;   ///< [0, 1]: vertices whose cells are all at least as good stay
};

struct HexSmoothing {
  double min_before = 0, min_after = 0;  ///< scaled Jacobian, over cells with a volume
  std::uint64_t moves = 0;
  std::int64_t sweeps = 0;  ///< done
  template <class A>
  void archive(A& a) {
    a(min_before, min_after, moves, sweeps);
  }
};

/// Moves vertices so that the worst scaled Jacobian of the cells around each never falls and mostly rises, and no cell
/// is turned over for it. Vertices over features of the plan (faults, sides, wells, curves) stay, and so do those of
/// cells without full volume; those on horizons, top and bottom slide on their triangles. Vertices that share a cell
/// move one after the other, all others at the same time; the same bits on every schedule. Fails with invalid_options.
Result<HexSmoothing> smooth_hexes(ExtrudedHexes& hexes, const LayeredSpace& space, const SmoothHexesOptions& options = {});

/// Smallest determinant of three unit edge vectors over the eight corners.
double scaled_jacobian(const std::array<Vec3, 8>& corners);

}  // namespace strataflow
