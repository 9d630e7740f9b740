#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// A segment of the plane between two points of a list.
using PlaneSegment = std::array<std::uint32_t, 2>;

/// Segments cut at everything they share.
struct SegmentArrangement {
  /// A part of an input segment, from the end nearer to its first point.
  struct Piece {
    std::uint32_t a = 0, b = 0;
    std::uint32_t segment = 0;
    friend constexpr bool operator==(const Piece&, const Piece&) = default;
  };
  std::vector<Vec3> points;             ///< the given ones, then the crossings by x, y; z is 0 there
  std::vector<std::uint32_t> place_of;  ///< per given point: the lowest one at its position
  std::vector<Piece> pieces;            ///< by segment, then along it; segments without length have none
};

/// Cuts segments of the plane z = 0 where they cross, touch, overlap or pass through a point. Crossings are found
/// exactly and then rounded to the nearest representable position, so pieces of the result may cross again by a
/// rounding error: call until no point is added. Coordinates must be finite.
SegmentArrangement arrange_segments(std::span<const Vec3> points, std::span<const PlaneSegment> segments);

/// The constrained Delaunay triangulation of the convex hull: counter-clockwise, in ascending order. Points are at
/// different positions; segments cross nowhere and pass through no point but their ends, else fails with
/// geometry_failed.
Result<std::vector<Triangle>> constrained_delaunay(std::span<const Vec3> points,
                                                   std::span<const PlaneSegment> segments);

}  // namespace strataflow
