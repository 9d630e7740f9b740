#pragma once
#include <array>
#include <cstdint>

#include "kernels/hexes/extrude_hexes.h"

namespace strataflow {

struct SmoothHexesOptions {
  std::int64_t sweeps = 10;    ///< ≥ 0: at most, first for Jacobians alone, then with warpage
  double below_quality = 0.6;  ///< [0, 1]: vertices whose cells are all at least as good stay
};

struct HexSmoothing {
  double min_before = 0, min_after = 0;          ///< scaled Jacobian, over cells with a volume
  double warpage_before = 0, warpage_after = 0;  ///< largest face_warpage_m of these cells, over the plan's mean edge
  std::uint64_t moves = 0;
  std::int64_t sweeps = 0;  ///< done, of both kinds
  template <class A>
  void archive(A& a) {
    a(min_before, min_after, warpage_before, warpage_after, moves, sweeps);
  }
};

/// Moves vertices, first so that the smallest scaled Jacobian of the cells around each rises; then also so that their
/// most warped face becomes flatter, where a warpage of 5 % of the plan's mean edge counts as `below_quality`. No step
/// lets the smallest scaled Jacobian around its vertex fall below that or what it was, and none turns a cell over.
/// Vertices over features of the plan (faults, sides, wells, curves) stay, and so do those of cells without full
/// volume; those on horizons, top and bottom slide on their triangles, but where a level bridges a gap of its horizon
/// (ExtrusionReport::bridged) they are free. Vertices that share a cell move one after the other, all others at the
/// same time; the same bits on every schedule. Fails with invalid_options.
Result<HexSmoothing> smooth_hexes(ExtrudedHexes& hexes, const LayeredSpace& space,
                                  const SmoothHexesOptions& options = {});

/// How far the corners of a cell's most warped face lie from its mean plane, metres.
double face_warpage_m(const std::array<Vec3, 8>& corners);

/// Smallest determinant of three unit edge vectors over the eight corners.
double scaled_jacobian(const std::array<Vec3, 8>& corners);

}  // namespace strataflow
