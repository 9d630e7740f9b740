#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "model/point_definition.h"
#include "model/triangle_soup.h"

namespace strataflow {

/// Where a point of a closed triangle lies in it: 0–2 a corner, 3–5 inside edge k − 3 (from corner k − 3 to the next),
/// 6 inside. This is the topological point of euler1999 §2.3.1, and it is never contradicted by coordinates.
using PlaceInTriangle = std::uint8_t;
inline constexpr PlaceInTriangle place_inside = 6;
inline constexpr PlaceInTriangle place_outside = 7;

/// The edges of the triangle (bit k for edge k) that a place lies on.
constexpr std::uint8_t edges_at(PlaceInTriangle place) {
  constexpr std::uint8_t bits[8] = {0b101, 0b011, 0b110, 0b001, 0b010, 0b100, 0, 0};
  return bits[place];
}

/// What two triangles share. At most six points (an overlap in one plane); a segment joins two of them.
struct PairContact {
  struct Point {
    PointDefinition definition;
    PlaceInTriangle in_first = place_outside, in_second = place_outside;
  };
  struct Segment {
    std::uint8_t from = 0, to = 0;  ///< indices into points
    /// The edge (two vertices) the segment lies on when the triangles share a plane; else no_index twice, and the
    /// segment lies in the planes of both.
    std::array<std::uint32_t, 2> edge;
  };
  std::vector<Point> points;
  std::vector<Segment> in_first;   ///< segments to draw in the first triangle (none along its own edges)
  std::vector<Segment> in_second;  ///< and in the second
  bool is_coplanar = false;        ///< one plane (they may share area)
};

/// Everything triangles `first` and `second` share, decided exactly (euler1999 §2.3.3 with the point case it leaves
/// out). Points are welded: equal positions have equal indices. Neither triangle may have zero area.
PairContact contact_of(const std::vector<Vec3>& points, const Triangle& first, const Triangle& second);

}  // namespace strataflow
