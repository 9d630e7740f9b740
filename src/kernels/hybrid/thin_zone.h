#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "kernels/hybrid/facing_triangles.h"
#include "kernels/hybrid/thin_cell.h"
#include "model/structural_model.h"

namespace strataflow {

/// Pairs of triangles that were given up, by cause.
struct DroppedPairs {
  std::uint64_t isolated = 0;       ///< no neighbour to share a side with, and no wall
  std::uint64_t inverted = 0;       ///< a cell that passes to triangles at its sides would not be positive, or flat
  std::uint64_t nonconforming = 0;  ///< faces that more than two cells share, or differently
  std::uint64_t crossing = 0;       ///< a side crosses a surface or another side
  std::uint64_t unfilled = 0;       ///< what they left of the region could not be filled with tetrahedra
  template <class A>
  void archive(A& a) {
    a(isolated, inverted, nonconforming, crossing, unfilled);
  }
};

/// A side of a triangle of the model that is a face of a cell, and the cell.
struct CoveredSide {
  std::uint32_t triangle = 0;
  std::uint32_t side = 0;  ///< 0 negative, 1 positive
  std::uint32_t cell = 0;
};

/// A quadrilateral face on the outside of the model, instead of two triangles in one plane.
struct WallQuad {
  std::array<std::uint32_t, 4> vertices{};  ///< counter-clockwise about the outward normal
  std::array<std::uint32_t, 2> triangles{};
  std::uint32_t surface = 0;
  std::uint32_t cell = 0;
};

/// The cells between facing triangles of one region. Vertices below the number of the model's points are these, the
/// rest is `points`. Everything else of the region can be filled with tetrahedra: only triangles lie between.
struct ThinZone {
  std::vector<ThinCell> cells;
  std::vector<Vec3> points;
  std::uint64_t layer_points = 0;   ///< of `points`: between layers of prisms
  std::uint64_t centre_points = 0;  ///< of `points`: inside cells that pass from quadrilaterals to triangles
  std::uint64_t apex_points = 0;    ///< of `points`: of pyramids on quadrilateral sides, beside the facing triangles
  std::vector<CoveredSide> covered;
  std::vector<WallQuad> wall_quads;
  std::vector<Triangle> envelope;  ///< faces inside the region with cells on one side only, away from which they look
  double volume_m3 = 0;
  DroppedPairs dropped;
};

/// Builds the cells between the `pairs` of one region, `layers` ≥ 1 from triangle to triangle. A quadrilateral side
/// without neighbour gets a pyramid on it, as far as there is room. Where there is none, or where the side lies on a
/// surface whose triangles are seen from both sides, its cell itself passes to triangles: as a pyramid and a
/// tetrahedron where that suffices, else as the pyramids and tetrahedra around its middle (pellerin2014 §2.11.6 (1)).
/// Only cells positive everywhere are kept, only faces that conform, and only sides that meet surfaces and one another
/// properly; the rest is dropped, until nothing changes (pellerin2014 §5 (ii)).
ThinZone build_thin_zone(const StructuralModel& model, std::uint32_t region, std::span<const FacingPair> pairs,
                         std::uint32_t layers);

}  // namespace strataflow
