#pragma once
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "kernels/quads/integer_constraint.h"
#include "model/corner_map.h"
#include "model/feature_mesh.h"

namespace strataflow {

__extension__ using Int128 = __int128;

/// A grid-preserving map without rounding errors: coordinates are integers in units of 2^−32 of a quad, transitions
/// are quarter turns and whole quads, and both agree exactly at every corner (coudert2024 R18).
struct GridMap {
  static constexpr std::int64_t unit = std::int64_t{1} << 32;

  std::vector<GaussianInteger> uv;       ///< per corner
  std::vector<std::uint32_t> opposite;   ///< per half-edge; no_index on the boundary
  std::vector<std::uint8_t> turns;       ///< per half-edge h: our chart = i^turns[h]·(opposite's chart) + shift[h]
  std::vector<GaussianInteger> shift;    ///< per half-edge, a multiple of `unit`
  std::vector<std::uint32_t> first_out;  ///< per point: the half-edge out of it that comes first counter-clockwise

  static constexpr std::uint32_t next(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static constexpr std::uint32_t previous(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }
  /// A position of the opposite triangle of h, in the chart of h.
  GaussianInteger into(std::uint32_t h, GaussianInteger there) const { return turned(there, turns[h]) + shift[h]; }
  /// A half-edge between two points of the mesh, from `a` to `b` unless the edge has only the other; no_index: none.
  std::uint32_t half_edge_between(const FeatureMesh& mesh, std::uint32_t a, std::uint32_t b) const;
};

/// Twice the area of abc: its sign tells on which side of ab c lies. Exact.
constexpr Int128 area(GaussianInteger a, GaussianInteger b, GaussianInteger c) {
  const GaussianInteger u = b - a, v = c - a;
  return Int128(u.re) * v.im - Int128(u.im) * v.re;
}
constexpr int side(GaussianInteger a, GaussianInteger b, GaussianInteger c) {
  const Int128 twice = area(a, b, c);
  return twice > 0 ? 1 : twice < 0 ? -1 : 0;
}

/// Rounds a map that is grid-preserving up to `tolerance`: translations, singular points and corners go to integers,
/// the constant coordinate of each feature edge too, everything else to the grid of units. Fails with geometry_failed
/// and names the point, feature or triangle when something is further off, does not close around a point or turns
/// a triangle over.
Result<GridMap> exact_grid_map(const FeatureMesh& mesh, const CornerMap& map, double tolerance = 1e-3);

}  // namespace strataflow
